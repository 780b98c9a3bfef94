//! Writes random models, the same for the same seed: what `script/random` builds.
//!
//! ```text
//! random_models KIND SEED              a model of a kind (generic, coincident, well-tops, sedimentary, round-sedimentary, referring, faulted, round-faulted,
//!                                          folded), as TOML
//! random_models KIND SEED --of A,B     the same with features of these kinds alone
//! random_models KIND SEED --plain      one that leaves no draw to the program
//! random_models KIND SEED --as WAY     that plain model thousandfold, thousandth, turned or mirrored
//! random_models volumes FILE           the volumes of such a model of horizons alone, by an integral over the plan, as JSON
//! ```
//!
//! Nothing here uses the library: what the models mean is told from the model files.

mod models;
mod plan;

use std::error::Error;
use std::io::Write;

use models::{Kind, Way};

const USAGE: &str = "random_models KIND SEED [--plain | --as WAY | --of KINDS], or random_models volumes FILE; kinds: generic, \
     coincident, well-tops, sedimentary, round-sedimentary, referring, faulted, round-faulted, folded; ways: thousandfold, thousandth, turned, mirrored";

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = args.iter().map(String::as_str).collect();
    let text = match words.as_slice() {
        ["volumes", file] => {
            let model = std::fs::read_to_string(file)?.parse()?;
            serde_json::to_string_pretty(&plan::volumes(&model)?)? + "\n"
        }
        [kind, seed] => {
            toml::to_string(&models::model(kind.parse::<Kind>()?, seed.parse()?, false))?
        }
        [kind, seed, "--of", kinds] => {
            let model = models::model(kind.parse::<Kind>()?, seed.parse()?, false);
            let kinds: Vec<&str> = kinds.split(',').collect();
            toml::to_string(&models::limited(model, &kinds))?
        }
        [kind, seed, "--plain"] => {
            toml::to_string(&models::model(kind.parse::<Kind>()?, seed.parse()?, true))?
        }
        [kind, seed, "--as", way] => {
            let model = models::model(kind.parse::<Kind>()?, seed.parse()?, true);
            let changed = models::changed(&model, way.parse::<Way>()?);
            toml::to_string(
                &changed
                    .ok_or("its belts interfinger as they are drawn, which no mirror changes, or it has kinds that are not changed here")?,
            )?
        }
        _ => return Err(USAGE.into()),
    };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}
