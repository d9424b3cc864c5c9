//! What is looked at, as headers have it.

use super::Builder;
use crate::scene::file;
use crate::scene::valid::Target;
use crate::units::Units;

/// Longest name: one line of a FITS header holds it.
const LONGEST: usize = 60;

impl Builder<'_> {
    pub(super) fn target(&mut self, file: &file::Target) -> Target {
        let plain = file.name.bytes().all(|byte| (b' '..=b'~').contains(&byte));
        if !plain || file.name.trim().is_empty() || file.name.len() > LONGEST {
            self.fault(
                &["target.name"],
                "`target.name` cannot stand in the header of a FITS file",
                format!("give 1 to {LONGEST} printable characters of ASCII"),
            );
        }
        Target {
            name: file.name.trim().to_owned(),
            right_ascension: file.right_ascension,
            declination: file.declination,
            mjd: file.mjd,
        }
    }
}

impl From<&file::Units> for Units {
    fn from(&file::Units { mass, distance, frequency }: &file::Units) -> Self {
        Self { mass, distance, frequency }
    }
}
