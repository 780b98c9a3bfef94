// Exceptions become Rust errors. Included by every shim, before any code that cxx generates.
//
// In OpenCASCADE 7 Standard_Failure is not a std::exception, and cxx's own handler would abort the process.
#pragma once

#include <Standard_Failure.hxx>
#include <Standard_Type.hxx>

#include <exception>
#include <stdexcept>
#include <string>

namespace clinothem::occt {

// The first word of a message says which kind of error it is; src/error.rs reads it.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled:") {}
};
struct BadInput : std::runtime_error {
  explicit BadInput(const std::string& what) : std::runtime_error("input:" + what) {}
};
struct NoFile : std::runtime_error {
  explicit NoFile(const std::string& what) : std::runtime_error("io:" + what) {}
};
// Alerts of the Boolean operations, one a line.
struct Alerts : std::runtime_error {
  explicit Alerts(const std::string& lines) : std::runtime_error("alerts:" + lines) {}
};
struct Refused : std::runtime_error {
  explicit Refused(const std::string& what) : std::runtime_error("kernel:" + what) {}
};

inline std::string describe(const Standard_Failure& failure) {
  std::string text = failure.DynamicType()->Name();
  const char* message = failure.GetMessageString();
  if (message != nullptr && *message != '\0') text = text + ": " + message;
  return text;
}

}  // namespace clinothem::occt

namespace rust::behavior {

template <typename Try, typename Fail>
static void trycatch(Try&& attempt, Fail&& fail) noexcept try {
  attempt();
} catch (const Standard_Failure& failure) {
  fail("kernel:" + clinothem::occt::describe(failure));
} catch (const std::exception& failure) {
  fail(failure.what());
} catch (...) {
  fail("kernel:an exception of unknown type");
}

}  // namespace rust::behavior
