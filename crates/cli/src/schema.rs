//! `embate schema`: the JSON schema of the model file.

use crate::{Failure, terminal};
use embate_files::model_file;

pub(crate) fn schema() -> Result<(), Failure> {
    terminal::print(&format!("{}\n", model_file::schema().trim_end()))
}
