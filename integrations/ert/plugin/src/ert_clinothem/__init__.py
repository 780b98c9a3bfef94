"""Forward-model steps of ERT that build and sample realisations with clinothem.

They run the same commands as the files in `steps/`, and check the program and the model before an experiment begins:
a model with a defect is told at once, not by each realisation.
"""

import shutil
import subprocess

import ert
from ert.config import (
    ForwardModelStepDocumentation,
    ForwardModelStepJSON,
    ForwardModelStepPlugin,
    ForwardModelStepValidationError,
)

PROGRAM = "clinothem"

# What both steps begin with; the realisation's number is its seed.
MODEL = [
    "<MODEL>",
    "--parameters",
    "<PARAMETERS>",
    "--parameter-names=<NAMES>",
    "--seed",
    "<IENS>",
    "--output",
    "<OUTPUT>",
]


class _Step(ForwardModelStepPlugin):
    def validate_pre_experiment(self, fm_step_json: ForwardModelStepJSON) -> None:
        program = shutil.which(PROGRAM)
        if program is None:
            raise ForwardModelStepValidationError(
                f"there is no program {PROGRAM}; put it into a folder of PATH, on the compute nodes too"
            )
        model = self.private_args.get("<MODEL>")
        if model is None or "<" in model:
            # Not given, which ERT tells; or another model for each realisation.
            return
        checked = subprocess.run([program, "check", model], capture_output=True, text=True, check=False)
        if checked.returncode != 0:
            raise ForwardModelStepValidationError(checked.stderr.strip())


class Clinothem(_Step):
    """`clinothem build`: exact volumes, and responses as files of a number each."""

    def __init__(self) -> None:
        super().__init__(
            name="CLINOTHEM",
            command=[
                PROGRAM,
                "build",
                *MODEL,
                "--formats",
                "<FORMATS>",
                "--responses",
                "<RESPONSES>",
                "--threads",
                "<NUM_CPU>",
            ],
            required_keywords=["<MODEL>"],
            default_mapping={
                "<PARAMETERS>": "parameters.json",
                "<OUTPUT>": "clinothem",
                "<FORMATS>": "none",
                "<RESPONSES>": "solids",
                # Without <NAMES>: an option that says what is so anyway.
                "--parameter-names=<NAMES>": "--proof=fast",
            },
        )

    @staticmethod
    def documentation() -> ForwardModelStepDocumentation | None:
        return ForwardModelStepDocumentation(
            category="modelling.reservoir",
            description=(
                "Builds a surface-based reservoir model with clinothem: the parameters in the runpath are keys of the "
                "model, the realisation's number is its seed."
            ),
            examples=(
                ".. code-block:: none\n\n"
                "  FORWARD_MODEL CLINOTHEM(<MODEL>=<CONFIG_PATH>/belt.toml, <RESPONSES>=net_to_gross)"
            ),
        )


class ClinothemGrid(_Step):
    """`clinothem grid`: cells with rock, as a flow simulator reads them."""

    def __init__(self) -> None:
        super().__init__(
            name="CLINOTHEM_GRID",
            command=[PROGRAM, "grid", *MODEL, "--formats", "<FORMATS>", "--cells", "<CELLS>", "--layers=<LAYERS>"],
            required_keywords=["<MODEL>"],
            default_mapping={
                "<PARAMETERS>": "parameters.json",
                "<OUTPUT>": "grid",
                "<FORMATS>": "grdecl",
                "<CELLS>": "100x100x50",
                # Without these: options that say what is so anyway.
                "--parameter-names=<NAMES>": "--samples=1",
                "--layers=<LAYERS>": "--most-gb=8",
            },
        )

    @staticmethod
    def documentation() -> ForwardModelStepDocumentation | None:
        return ForwardModelStepDocumentation(
            category="modelling.reservoir",
            description="Samples the realisation that CLINOTHEM builds on a grid, for a flow simulator.",
            examples=(
                ".. code-block:: none\n\n"
                "  FORWARD_MODEL CLINOTHEM_GRID(<MODEL>=<CONFIG_PATH>/coast.toml, <CELLS>=50x80, <LAYERS>=10)"
            ),
        )


@ert.plugin(name="clinothem")
def installable_forward_model_steps() -> list[type[ForwardModelStepPlugin]]:
    return [Clinothem, ClinothemGrid]
