//! How brightly a disk shines in a line.

use thiserror::Error;

/// ε(r), in the frame of the matter.
#[derive(Clone, Debug, PartialEq)]
pub enum Emissivity {
    /// r^−q.
    Power(f64),
    /// Points (r, ε) in the order of r, between which ε is a power of r.
    Table(Vec<[f64; 2]>),
}

/// What is wrong with a table.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum TableError {
    /// Not two numbers.
    #[error("line {0}: give a radius and an emissivity, both above 0, separated by a comma or a space")]
    Line(usize),
    /// Out of order.
    #[error("line {0}: the radius is not larger than that of the line before")]
    Order(usize),
    /// Too short.
    #[error("a table of emissivity has two lines at least")]
    Short,
    /// Too long.
    #[error("a table of emissivity has at most {} lines", Emissivity::MOST)]
    Long,
}

impl Emissivity {
    /// Lines that a table has at most.
    pub const MOST: usize = 100_000;

    /// Reads a table of lines "r, ε" (or with spaces); lines that begin with # and, first of all, the names of columns are
    /// passed over.
    ///
    /// # Errors
    /// All lines that are wrong, up to ten.
    pub fn read(text: &str) -> Result<Self, Vec<TableError>> {
        let mut rows: Vec<[f64; 2]> = Vec::new();
        let mut faults = Vec::new();
        let mut first = true;
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let parts: Vec<&str> =
                line.split([',', ' ', '\t', ';']).filter(|part| !part.is_empty()).collect();
            let numbers: Vec<f64> = parts.iter().filter_map(|part| part.parse().ok()).collect();
            let names = first && numbers.is_empty();
            first = false;
            if names {
                continue;
            }
            match numbers[..] {
                [r, e] if parts.len() == 2 && r > 0.0 && e > 0.0 && r.is_finite() && e.is_finite() => {
                    if rows.last().is_some_and(|last| last[0] >= r) {
                        faults.push(TableError::Order(number));
                    } else {
                        rows.push([r, e]);
                    }
                }
                _ => faults.push(TableError::Line(number)),
            }
            if rows.len() > Self::MOST {
                faults.push(TableError::Long);
            }
            if faults.len() >= 10 || rows.len() > Self::MOST {
                return Err(faults);
            }
        }
        if rows.len() < 2 && faults.is_empty() {
            faults.push(TableError::Short);
        }
        if faults.is_empty() { Ok(Self::Table(rows)) } else { Err(faults) }
    }

    /// The radii that a table is given for.
    pub fn range(&self) -> Option<[f64; 2]> {
        match self {
            Self::Power(_) => None,
            Self::Table(rows) => Some([rows.first()?[0], rows.last()?[0]]),
        }
    }

    /// ε at r; beyond a table's ends the power law goes on.
    pub fn at(&self, r: f64) -> f64 {
        match self {
            Self::Power(q) => r.powf(-q),
            Self::Table(rows) => {
                let after = rows.partition_point(|row| row[0] < r).clamp(1, rows.len() - 1);
                let ([r0, e0], [r1, e1]) = (rows[after - 1], rows[after]);
                e0 * ((r / r0).ln() / (r1 / r0).ln() * (e1 / e0).ln()).exp()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_powers_between_their_points() {
        let table = Emissivity::read("r, emissivity\n# a comment\n2, 1\n4 0.125\n\n8\t1\n").unwrap();
        assert_eq!(table.range(), Some([2.0, 8.0]));
        for (r, expected) in [(2.0, 1.0), (3.0, (2f64 / 3.0).powi(3)), (4.0, 0.125), (8.0, 1.0)] {
            assert!((table.at(r) / expected - 1.0).abs() < 1e-14, "{r}");
        }
        assert_eq!(Emissivity::Power(3.0).at(2.0), 0.125);
    }

    #[test]
    fn all_that_is_wrong_is_said() {
        let faults = Emissivity::read("1 1\n2\n3 -1\n0.5 1\nx y").unwrap_err();
        let expected = [TableError::Line(2), TableError::Line(3), TableError::Order(4), TableError::Line(5)];
        assert_eq!(faults, expected);
        assert_eq!(Emissivity::read("1 2"), Err(vec![TableError::Short]));
        assert_eq!(Emissivity::read(""), Err(vec![TableError::Short]));
    }
}
