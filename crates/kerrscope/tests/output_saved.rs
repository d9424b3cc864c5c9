//! Files for science, read as the films that they were.

use std::path::Path;

use kerrscope::output::{Format, Saved, SavedError, draft};
use kerrscope::render::{Film, Stage, Watch, draw};
use kerrscope::scene::Scene;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const SHINING: &str = "observer.distance = 100\nscreen = { kind = 'angular', field_of_view = 24 }\n\
    disk = { model = 'page-thorne', outer = 15, light = 'blackbody', temperature = 1e10 }\nsky.kind = 'black'\n\
    units = { mass = 6.5e9, distance = 16.8e6, frequency = 230e9 }\n\
    render = { width = 20, height = 12, samples = 2, layers = ['fate', 'r', 'g', 'depth'] }";

fn drawn(text: &str) -> Result<(Scene, Film), Box<dyn std::error::Error>> {
    let scene = Scene::from_toml(text, Path::new(""))?;
    let film = draw(&Stage::new(&scene)?, &Watch::default())?;
    Ok((scene, film))
}

/// Bits, for NaN is what many rays have.
fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn a_film_is_the_same_again() -> Outcome {
    let bolometric =
        SHINING.replace(", frequency = 230e9", "").replace(", light = 'blackbody', temperature = 1e10", "");
    let plain = SHINING.replace(
        "units = { mass = 6.5e9, distance = 16.8e6, frequency = 230e9 }\n",
        "units.frequency = 1e11\n",
    );
    let picture = "render = { width = 9, height = 7, samples = 1 }";
    let folder = tempfile::tempdir()?;
    for text in [SHINING, &bolometric, &plain, picture] {
        let (scene, film) = drawn(text)?;
        for ending in ["fits", "h5"] {
            let path = folder.path().join("film").with_extension(ending);
            Format::of(&path).ok_or("no format")?.write(&path, &scene, &film)?;
            let Saved { scene: again, film: read, provenance, draft } = Saved::open(&path)?;
            assert_eq!(again, scene);
            assert_eq!(draft.text, scene.to_toml());
            assert_eq!(provenance.scene_toml, scene.to_toml());
            assert_eq!((read.width, read.height, read.radiance), (film.width, film.height, film.radiance));
            assert_eq!((&read.light, read.level), (&film.light, film.level));
            assert_eq!(read.intensity.len(), film.intensity.len());
            for (read, written) in read.intensity.iter().zip(&film.intensity) {
                assert!((read - written).abs() <= 2e-16 * written, "{read} {written}");
            }
            assert_eq!(read.planes.len(), film.planes.len());
            for plane in &film.planes {
                let same = read.plane(plane.channel).ok_or("a plane is missing")?;
                assert_eq!(bits(&same.values), bits(&plane.values), "{:?}", plane.channel);
            }
            assert_eq!(read.tally.interpolation, film.tally.interpolation);
        }
    }
    Ok(())
}

#[test]
fn what_is_no_such_file_is_told() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    let told = |name: &str| Saved::open(&path(name)).map(|_| ()).unwrap_err();
    assert!(
        matches!(told("none.fits"), SavedError::File(error) if error.kind == Some(std::io::ErrorKind::NotFound))
    );
    let (scene, film) = drawn("render = { width = 9, height = 7, samples = 1 }")?;
    Format::Png.write(&path("film.png"), &scene, &film)?;
    assert!(told("film.png").to_string().contains("FITS and HDF5"));
    for (ending, format) in [("fits", Format::Fits), ("h5", Format::Hdf5)] {
        let whole = path("film").with_extension(ending);
        format.write(&whole, &scene, &film)?;
        let bytes = std::fs::read(&whole)?;
        for length in [0, 10, bytes.len() / 3, bytes.len() - 3000] {
            std::fs::write(path("part").with_extension(ending), &bytes[..length])?;
            let error = Saved::open(&path("part").with_extension(ending)).map(|_| ()).unwrap_err();
            assert!(
                matches!(error, SavedError::File(ref error) if error.kind.is_none()),
                "{ending} {length}: {error}"
            );
        }
    }
    Ok(())
}

#[test]
fn scenes_are_found_in_scene_files_and_pictures() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, "spacetime.spin = 0.3 # slow")?;
    let mut found = draft(&file)?;
    assert_eq!((found.text.as_str(), found.folder.as_path()), ("spacetime.spin = 0.3 # slow", folder.path()));
    found.set("spacetime.spin", "0.4");
    assert_eq!(found.scene()?.spacetime.spin(), Some(0.4));
    let (scene, film) = drawn("render = { width = 9, height = 7, samples = 1 }")?;
    let path = folder.path().join("film.exr");
    Format::Exr.write(&path, &scene, &film)?;
    assert_eq!(draft(&path)?.scene()?, scene);
    assert!(matches!(draft(&folder.path().join("none.toml")), Err(SavedError::Scene(_))));
    Ok(())
}
