//! FITS and HDF5 files: every number bit for bit, as astropy, h5py and ehtim read it.

use std::fs;
use std::path::Path;
use std::process::Command;

use kerrscope::display::{Depth, Picture};
use kerrscope::light::Radiance;
use kerrscope::output::{Format, ImageSet, Intensity, Provenance, fits, hdf5, png};
use kerrscope::render::{Film, Stage, Watch, draw};
use kerrscope::scene::Scene;

const SCENE: &str = "observer = { distance = 1000, inclination = 60 }\n\
    screen = { kind = 'angular', field_of_view = 1.6 }\n\
    units = { mass = 6.5e9, distance = 16.8e6, frequency = 230e9 }\n\
    target = { name = 'M87', right_ascension = 187.70593, declination = 12.39112, mjd = 57850.25 }\n\
    [render]\nwidth = 48\nheight = 30\nsamples = 1\nlayers = ['fate', 'r', 'phi', 'error']";

fn drawn() -> (Scene, Film) {
    let scene = Scene::from_toml(SCENE, Path::new("")).unwrap();
    let stage = Stage::new(&scene).unwrap();
    let film = draw(&stage, &Watch::default()).unwrap();
    (scene, film)
}

/// A bright spot at the upper left, and something everywhere: W m⁻² Hz⁻¹ sr⁻¹.
fn spot() -> Vec<f64> {
    let near = |x: f64, y: f64| (-0.05 * ((x - 10.0).powi(2) + (y - 6.0).powi(2))).exp();
    (0..48 * 30).map(|i| 1e-4 * (near(f64::from(i % 48), f64::from(i / 48)) + 1e-9 * f64::from(i))).collect()
}

/// Set by `cargo xtask test`, which makes a Python environment with what is in requirements.txt.
fn python(script: &str, folder: &Path) -> Option<String> {
    let Some(python) = std::env::var_os("KERRSCOPE_TEST_PYTHON") else {
        eprintln!("skipped: KERRSCOPE_TEST_PYTHON is not set");
        return None;
    };
    let output = Command::new(python).args(["-c", script]).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// A picture's rows as FITS has them, or as they are.
fn rows(values: &[f64], flipped: bool) -> Vec<u64> {
    let mut rows: Vec<&[f64]> = values.chunks_exact(48).collect();
    if flipped {
        rows.reverse();
    }
    rows.concat().iter().map(|value| value.to_bits()).collect()
}

fn check(folder: &Path, set: &ImageSet<'_>, flipped: bool) {
    for image in set.images() {
        let raw = fs::read(folder.join(format!("{}.raw", image.name))).unwrap();
        let read: Vec<u64> = raw.as_chunks().0.iter().map(|&bytes| u64::from_le_bytes(bytes)).collect();
        let values: Vec<f64> = (0..48 * 30).map(|pixel| image.value(pixel)).collect();
        assert!(read == rows(&values, flipped), "{}", image.name);
    }
}

const ASTROPY: &str = r"
import sys
from astropy.io import fits
from astropy.wcs import WCS
with fits.open('a.fits', checksum=True) as file:
    file.verify('exception')
    for k, hdu in enumerate(file):
        if hdu.name == 'KERRSCOPE':
            open('record.txt', 'wb').write(hdu.data.tobytes())
            continue
        assert hdu.header['BITPIX'] == -64 and hdu.data.shape == (30, 48), hdu.header
        name = hdu.header.get('EXTNAME', 'intensity')
        hdu.data.astype('<f8').tofile(name + '.raw')
    header = file[0].header
    for key in ('CTYPE1', 'CTYPE2', 'CRPIX1', 'CRPIX2', 'CRVAL1', 'CRVAL2', 'CDELT1', 'CDELT2', 'OBSRA', 'OBSDEC', 'RA', 'DEC',
                'FREQ', 'MJD', 'OBJECT', 'BUNIT', 'STOKES', 'BHMASS', 'THETAG'):
        print(key, header[key])
    assert len(file) == 13, len(file)
    assert file['phi' if 'phi' in file else 'n1.phi'].header['BUNIT'] == 'rad'
    sky = WCS(header)
    ra, dec = sky.wcs_pix2world([[10.0, 23.0]], 0)[0]
    print('UPPERLEFT', ra > header['OBSRA'], dec > header['OBSDEC'])
";

#[test]
fn astropy_reads_every_bit() {
    let (scene, film) = drawn();
    let values = spot();
    let set = ImageSet::of(&scene, &film)
        .with_intensity(Intensity { values: &values, radiance: Radiance::Specific });
    let folder = tempfile::tempdir().unwrap();
    fits::write(&folder.path().join("a.fits"), &set).unwrap();
    let Some(said) = python(ASTROPY, folder.path()) else { return };
    check(folder.path(), &set, true);
    let word = |key: &str| {
        said.lines()
            .find_map(|line| line.strip_prefix(&format!("{key} ")))
            .unwrap_or_else(|| panic!("{key}: {said}"))
    };
    let number = |key: &str| word(key).parse::<f64>().unwrap();
    // 1.6° over 30 pixels, 1000 M away, at 3.818993 µas for M.
    let degrees = 1.6_f64.to_radians() / 30.0 * 1000.0 * 3.818993 / 3.6e9;
    assert!((number("CDELT1") / -degrees - 1.0).abs() < 1e-7 && number("CDELT2") == -number("CDELT1"));
    assert_eq!((number("CRPIX1"), number("CRPIX2")), (24.5, 15.5));
    for key in ["CRVAL1", "OBSRA", "RA"] {
        assert!((number(key) - 187.70593).abs() < 1e-12);
    }
    for key in ["CRVAL2", "OBSDEC", "DEC"] {
        assert!((number(key) - 12.39112).abs() < 1e-12);
    }
    assert_eq!((number("FREQ"), number("MJD"), number("BHMASS")), (230e9, 57850.25, 6.5e9));
    assert_eq!((word("CTYPE1"), word("CTYPE2")), ("RA---SIN", "DEC--SIN"));
    assert_eq!((word("OBJECT"), word("BUNIT"), word("STOKES")), ("M87", "JY/PIXEL", "I"));
    assert_eq!(word("UPPERLEFT"), "True True", "North-East is at the upper left");
    let record = fs::read_to_string(folder.path().join("record.txt")).unwrap();
    assert_eq!(record.parse(), Ok(Provenance::of(&scene, &film)));
}

const EHTIM: &str = r"
import numpy as np, ehtim as eh
image = eh.image.load_fits('a.fits')
print('FLUX', repr(float(image.total_flux())))
print('PSIZE', repr(float(image.psize)))
print('SIZE', image.xdim, image.ydim)
print('RF', repr(float(image.rf)), image.source, repr(float(image.ra)), repr(float(image.dec)), image.mjd, image.time)
x, y = image.centroid()
print('CENTROID', repr(float(x)), repr(float(y)))
peak = image.imarr()
print('PEAK', *np.unravel_index(np.argmax(peak), peak.shape))
";

#[test]
fn ehtim_sees_the_same() {
    let (scene, film) = drawn();
    let values = spot();
    let set = ImageSet::of(&scene, &film)
        .with_intensity(Intensity { values: &values, radiance: Radiance::Specific });
    let folder = tempfile::tempdir().unwrap();
    fits::write(&folder.path().join("a.fits"), &set).unwrap();
    let Some(said) = python(EHTIM, folder.path()) else { return };
    let words = |key: &str| -> Vec<&str> {
        let line = said.lines().find_map(|line| line.strip_prefix(&format!("{key} ")));
        line.unwrap_or_else(|| panic!("{key}: {said}")).split_whitespace().collect()
    };
    let numbers = |key: &str| -> Vec<f64> { words(key).iter().map(|word| word.parse().unwrap()).collect() };
    assert!((numbers("FLUX")[0] / set.total_flux().unwrap() - 1.0).abs() < 1e-12, "{said}");
    let angle = set.pixel_angle().unwrap();
    assert!((numbers("PSIZE")[0] / angle - 1.0).abs() < 1e-12, "{said}");
    assert_eq!(words("SIZE"), ["48", "30"]);
    let about = words("RF");
    assert_eq!((about[0], about[1], about[4], about[5]), ("230000000000.0", "M87", "57850", "6.0"));
    assert!((about[2].parse::<f64>().unwrap() - 187.70593 / 15.0).abs() < 1e-12);
    // Its arrays have the picture's top row first; x is to the East, so the spot at the upper left has x > 0 and y > 0.
    assert_eq!(words("PEAK"), ["6", "10"]);
    let ours = set.moments(angle).unwrap().centroid;
    let theirs = numbers("CENTROID");
    assert!(
        (theirs[0] + ours[0]).abs() < 1e-6 * angle && (theirs[1] - ours[1]).abs() < 1e-6 * angle,
        "{said} {ours:?}"
    );
    assert!(theirs[0] > 0.0 && theirs[1] > 0.0);
}

const H5PY: &str = r"
import h5py
with h5py.File('a.h5') as file:
    for name, data in file.items():
        if name == 'kerrscope':
            open('record.txt', 'wb').write(data[0])
            continue
        assert data.shape == (30, 48) and data.dtype == 'float64', name
        data[:].astype('<f8').tofile(name + '.raw')
        print(name, repr(data.attrs['unit']), data.attrs['title'])
    for name, value in file.attrs.items():
        print(name, value)
";

#[test]
fn h5py_reads_every_bit() {
    let (scene, film) = drawn();
    let values = spot();
    let set = ImageSet::of(&scene, &film)
        .with_intensity(Intensity { values: &values, radiance: Radiance::Specific });
    let folder = tempfile::tempdir().unwrap();
    hdf5::write(&folder.path().join("a.h5"), &set).unwrap();
    let Some(said) = python(H5PY, folder.path()) else { return };
    check(folder.path(), &set, false);
    for line in [
        "intensity 'JY/PIXEL' flux density",
        "n1.phi 'rad' azimuth φ, image order 1",
        "object M87",
        "mass_solar 6500000000.0",
        "frequency_hz 230000000000.0",
        "mjd 57850.25",
        "seed 1",
    ] {
        assert!(said.lines().any(|said| said == line), "{line}: {said}");
    }
    let record = fs::read_to_string(folder.path().join("record.txt")).unwrap();
    assert_eq!(record.parse(), Ok(Provenance::of(&scene, &film)));
}

/// Both formats without units, through the door that the program uses, and back.
#[test]
fn the_same_picture_is_the_same_bytes_and_says_how_it_was_made() {
    let folder = tempfile::tempdir().unwrap();
    let dot = Picture { width: 1, height: 1, pixels: vec![[0.5, 0.2, 0.0]] };
    let (plain, plain_film) = drawn();
    png::write(&folder.path().join("φ.png"), &dot, Depth::Eight, &Provenance::of(&plain, &plain_film))
        .unwrap();
    // A record that is longer than an attribute of HDF5 can be, and no ASCII.
    let things = "[[object]]\nshape = 'sphere'\ncenter = [0, 50, 0]\nradius = 1\n".repeat(600);
    let text = format!(
        "target.name = '{}'\ndisk = {{ model = 'image', image = 'φ.png' }}\nscreen.kind = 'angular'\n\
         render = {{ width = 3, height = 2, samples = 1 }}\n{things}",
        "a".repeat(60)
    );
    let scene = Scene::from_toml(&text, folder.path()).unwrap();
    let film = draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap();
    let record = Provenance::of(&scene, &film).to_string();
    assert!(record.len() > 1 << 16 && record.contains('φ'));
    for (first, second) in [("a.fits", "b.FITS"), ("a.h5", "b.hdf5"), ("c.fit", "d.fts")] {
        let [a, b] = [first, second].map(|name| folder.path().join(name));
        let format = Format::of(&a).unwrap();
        assert_eq!(Format::of(&b), Some(format));
        for path in [&a, &b] {
            format.write(path, &scene, &film).unwrap();
        }
        let bytes = fs::read(&a).unwrap();
        assert!(bytes == fs::read(&b).unwrap());
        assert_eq!(format.read_provenance(&a).unwrap(), Provenance::of(&scene, &film));
        // Half a file, another file and no file.
        for contents in [&bytes[..bytes.len() / 2], b"SIMPLE  = no", b"\x89HDF\r\n\x1a\n and no more", b""] {
            fs::write(&a, contents).unwrap();
            let message = format.read_provenance(&a).unwrap_err().to_string();
            assert!(message.contains(first), "{message}");
        }
        fs::remove_file(&a).unwrap();
        assert!(format.read_provenance(&a).unwrap_err().to_string().contains("there is no such file"));
    }
}
