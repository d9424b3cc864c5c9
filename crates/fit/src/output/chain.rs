//! Chains as HDF5 files, laid out as ArviZ lays out inference data.
//!
//! The group `posterior` has a dataset for each free parameter by its name, of 64-bit floating-point numbers, chain × draw,
//! whose attribute `unit` is its unit, empty for a number. The group `sample_stats` has `lp`, the logarithm of the posterior's
//! density, in the same shape, and the attribute `diverging`, the number of trajectories of all chains that went astray. Both groups
//! have the coordinates `chain` and `draw`, counted from 0, whose attributes CLASS and NAME make them dimensions to h5netcdf, with which
//! ArviZ and xarray read files. (It finds the dimensions of a dataset by their lengths, because references to them, DIMENSION_LIST, are
//! not there; netCDF's own library numbers them.) The root's attributes say how the file was made: `program`, `version`,
//! `seed`, and `model`, a list of `name = value`.
//!
//! There is no date: the same chains are the same bytes. The whole file is made in memory.

use std::io::{self, Write};
use std::path::Path;

use hdf5_pure::{AttrValue, Error, FileBuilder, GroupBuilder};
use kerrscope::output::FileError;
use kerrscope::output::file::write_atomically;

use super::Record;
use crate::fit::Fit;

/// Draws that are compressed together.
const CHUNK: u64 = 4096;

/// Writes the chains of a fit, whole or not at all.
///
/// # Errors
/// When there are no draws, or the file cannot be written.
pub fn write(path: &Path, fit: &Fit, record: &Record<'_>) -> Result<(), FileError> {
    write_atomically(path, |to| encode(to, fit, record))
}

/// Writes the chains of a fit to any place that takes bytes.
///
/// # Errors
/// When there are no draws, or that place fails.
pub fn encode(to: impl Write, fit: &Fit, record: &Record<'_>) -> io::Result<()> {
    // Chains are as long as each other; were one shorter, all would end with it.
    let longest = fit.draws.iter().map(Vec::len).chain(fit.logs.iter().map(Vec::len)).min().unwrap_or(0);
    let shape = [fit.draws.len(), longest];
    if shape.contains(&0) || fit.logs.len() != shape[0] {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "there are no draws to write"));
    }
    let mut file = FileBuilder::new();
    let mut posterior = file.create_group("posterior");
    coordinates(&mut posterior, shape);
    for (k, (name, unit)) in fit.free.iter().enumerate() {
        let values = fit.draws.iter().flat_map(|chain| chain[..longest].iter().map(|draw| draw[k]));
        dataset(&mut posterior, name, unit, &values.collect::<Vec<_>>(), shape);
    }
    file.add_group(posterior.finish());
    let mut statistics = file.create_group("sample_stats");
    coordinates(&mut statistics, shape);
    let logs: Vec<f64> = fit.logs.iter().flat_map(|chain| chain[..longest].iter().copied()).collect();
    dataset(&mut statistics, "lp", "", &logs, shape);
    statistics.set_attr("diverging", AttrValue::U64(fit.diverged as u64));
    file.add_group(statistics.finish());
    file.set_attr("program", AttrValue::VarLenString(Record::PROGRAM.to_owned()));
    file.set_attr("version", AttrValue::VarLenString(Record::VERSION.to_owned()));
    file.set_attr("seed", AttrValue::U64(record.seed));
    file.set_attr("model", AttrValue::VarLenStringArray(record.lines().collect()));
    file.finish_to(to).map_err(|error| match error {
        Error::Io(e) => e,
        other => io::Error::other(other.to_string()),
    })
}

/// Numbers of the chains and of the draws, as dimension scales.
fn coordinates(group: &mut GroupBuilder, shape: [usize; 2]) {
    for (name, count) in ["chain", "draw"].into_iter().zip(shape.map(|count| count as u64)) {
        let numbers: Vec<i64> = (0..count).map(u64::cast_signed).collect();
        group
            .create_dataset(name)
            .with_i64_data(&numbers)
            .with_shape(&[count])
            .set_attr("CLASS", AttrValue::AsciiString("DIMENSION_SCALE".to_owned()))
            .set_attr("NAME", AttrValue::AsciiString(name.to_owned()));
    }
}

fn dataset(group: &mut GroupBuilder, name: &str, unit: &str, values: &[f64], shape: [usize; 2]) {
    let [chains, draws] = shape.map(|count| count as u64);
    group
        .create_dataset(name)
        .with_f64_data(values)
        .with_shape(&[chains, draws])
        .with_chunks(&[1, draws.min(CHUNK)])
        .with_shuffle()
        .with_deflate(4)
        .set_attr("unit", AttrValue::VarLenString(unit.to_owned()));
}

#[cfg(test)]
mod tests {
    use hdf5_pure::File;

    use super::*;
    use crate::output::synthetic;

    fn text(value: &AttrValue) -> &str {
        let AttrValue::VarLenString(text) = value else { panic!("{value:?} is no text") };
        text
    }

    #[test]
    fn draws_are_read_back() -> Result<(), Box<dyn std::error::Error>> {
        let fit = synthetic::fit(&synthetic::image([8, 8]));
        let model = [("model".to_owned(), "ring".to_owned()), ("blur".to_owned(), "2.5 ± π".to_owned())];
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("chains.h5");
        write(&path, &fit, &Record { seed: u64::MAX, model: &model })?;
        let file = File::open(&path)?;
        for (k, (name, unit)) in fit.free.iter().enumerate() {
            let set = file.dataset(&format!("posterior/{name}"))?;
            assert_eq!(set.shape()?, synthetic::SHAPE.map(|n| n as u64));
            let values: Vec<f64> = fit.draws.iter().flatten().map(|draw| draw[k]).collect();
            assert_eq!(set.read_f64()?, values, "{name}");
            assert_eq!(text(&set.attrs()?["unit"]), unit);
        }
        assert_eq!(file.dataset("sample_stats/lp")?.read_f64()?, fit.logs.concat());
        assert_eq!(file.group("sample_stats")?.attrs()?["diverging"], AttrValue::U64(3));
        let draw = file.dataset("posterior/draw")?.read_i64()?;
        assert_eq!((draw.len(), draw[0], draw[499]), (500, 0, 499));
        let attributes = file.root().attrs()?;
        assert_eq!(text(&attributes["program"]), "kerrscope");
        assert_eq!(text(&attributes["version"]), env!("CARGO_PKG_VERSION"));
        assert_eq!(attributes["seed"], AttrValue::U64(u64::MAX));
        let lines = ["model = ring", "blur = 2.5 ± π"].map(str::to_owned).to_vec();
        assert_eq!(attributes["model"], AttrValue::VarLenStringArray(lines));
        Ok(())
    }

    /// Nothing is written of a fit without draws, and what was there stays.
    #[test]
    fn none_is_refused() -> Result<(), Box<dyn std::error::Error>> {
        let mut fit = synthetic::fit(&synthetic::image([8, 8]));
        fit.draws.iter_mut().for_each(Vec::clear);
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("chains.h5");
        std::fs::write(&path, "old")?;
        let error = write(&path, &fit, &Record { seed: 1, model: &[] }).unwrap_err();
        assert!(error.to_string().contains("there are no draws"), "{error}");
        assert_eq!(std::fs::read_to_string(&path)?, "old");
        Ok(())
    }

    #[test]
    fn same_bytes() -> io::Result<()> {
        let fit = synthetic::fit(&synthetic::image([8, 8]));
        let mut files = [Vec::new(), Vec::new()];
        for file in &mut files {
            encode(file, &fit, &Record { seed: 1, model: &[] })?;
        }
        assert!(!files[0].is_empty() && files[0] == files[1]);
        Ok(())
    }
}
