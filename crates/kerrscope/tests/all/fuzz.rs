//! The seeds of the fuzz targets, as they are and with changes at random, the same ones each time.
//! libFuzzer goes on from there: `cargo xtask fuzz`.

use std::path::Path;

use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::{RngSeed, TestRunner};

#[path = "../../../../fuzz/src/lib.rs"]
mod targets;

/// Gives a target its seeds, then so many changed ones.
fn run(name: &str, target: fn(&[u8]), cases: u32) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(name);
    let mut paths: Vec<_> =
        folder.read_dir().expect("there are seeds").map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let seeds: Vec<Vec<u8>> = paths.iter().map(|path| std::fs::read(path).unwrap()).collect();
    assert!(seeds.len() >= 12, "{} seeds in {}", seeds.len(), folder.display());
    for (path, seed) in paths.iter().zip(&seeds) {
        println!("{}", path.display());
        target(seed);
    }
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    };
    let changed = |(seed, changes)| {
        target(&changed(&seeds, seed, changes));
        Ok(())
    };
    if let Err(failure) = TestRunner::new(config).run(&(any::<Index>(), changes()), changed) {
        panic!("{name}: {failure}");
    }
}

/// What is put in the place of how many bytes, and where.
type Change = (Index, usize, Piece);

#[derive(Clone, Debug)]
enum Piece {
    Bytes(Vec<u8>),
    /// Of a seed.
    Part(Index, Index, usize),
}

fn changes() -> impl Strategy<Value = Vec<Change>> {
    let numbers: Vec<&[u8]> =
        vec![&[0], &[0xFF], &[0, 0, 0, 0], &[0xFF; 4], &[0xFF, 0xFF, 0xFF, 0x7F], &[0x7F, 0xFF, 0xFF, 0xFF]];
    let piece = prop_oneof![
        prop::collection::vec(any::<u8>(), 0..8).prop_map(Piece::Bytes),
        select(numbers).prop_map(|number| Piece::Bytes(number.to_vec())),
        (any::<Index>(), any::<Index>(), 0..40_usize).prop_map(|(seed, at, n)| Piece::Part(seed, at, n)),
    ];
    prop::collection::vec((any::<Index>(), 0..8_usize, piece), 1..5)
}

fn changed(seeds: &[Vec<u8>], seed: Index, changes: Vec<Change>) -> Vec<u8> {
    let mut bytes = seed.get(seeds).clone();
    for (at, length, piece) in changes {
        let start = at.index(bytes.len() + 1);
        let end = (start + length).min(bytes.len());
        let piece = match piece {
            Piece::Bytes(bytes) => bytes,
            Piece::Part(seed, at, length) => {
                let seed = seed.get(seeds);
                let start = at.index(seed.len() + 1);
                seed[start..(start + length).min(seed.len())].to_vec()
            }
        };
        bytes.splice(start..end, piece);
    }
    bytes
}

#[test]
fn scene() {
    run("scene", targets::scene, 50_000);
}

#[test]
fn overrides() {
    run("overrides", targets::overrides, 50_000);
}

#[test]
fn texture() {
    run("texture", targets::texture, 50_000);
}

#[test]
fn provenance() {
    run("provenance", targets::provenance, 50_000);
}
