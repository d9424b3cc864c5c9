//! Pictures that cannot be measured, and why.

use std::path::PathBuf;

use crate::texture::TextureFault;

/// A picture that cannot be measured, and why.
#[derive(Debug, thiserror::Error)]
#[error("cannot take {} as a picture: {fault}; {}", path.display(), fault.mend())]
pub struct PictureError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub fault: PictureFault,
}

/// What can be wrong with a picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureFault {
    /// The file is in a format for which this is known, and cannot be used.
    #[error("{}", foreign(.0))]
    File(#[from] TextureFault),
    /// The file has no picture in it.
    #[error("no image with data is in the file")]
    NoImage,
    /// The picture has no pixels.
    #[error("the picture has no pixels")]
    NoPixels,
    /// An array with another number of axes than a picture has.
    #[error("its array of {0} is no picture: two axes longer than 1 at most")]
    Axes(String),
    /// The file contradicts itself.
    #[error("the file is damaged ({0})")]
    Damaged(String),
    /// A layer without numbers that can be a picture.
    #[error("no layer has a channel intensity, R, G and B, or Y")]
    NoChannels,
    /// The picture is larger than this program takes.
    #[error("{width}×{height} pixels are more than 16384 along an edge or 67108864 in all")]
    TooLarge {
        /// Pixels along the top edge.
        width: usize,
        /// Pixels along the left edge.
        height: usize,
    },
    /// Pixels are not as wide as they are high.
    #[error("its pixels are not square: {0} by {1}")]
    NotSquare(f64, f64),
    /// Not one value a pixel.
    #[error("{values} values are not {width}×{height} pixels")]
    Count {
        /// Numbers given.
        values: usize,
        /// Pixels along the top edge.
        width: usize,
        /// Pixels along the left edge.
        height: usize,
    },
    /// Pixels without a number.
    #[error(
        "{count} of {of} pixels are no finite number, the first in column {column}, row {row} (from 0, at the top left)"
    )]
    NotFinite {
        /// How many.
        count: usize,
        /// Pixels of the picture.
        of: usize,
        /// Where the first is.
        column: usize,
        /// Where the first is.
        row: usize,
    },
    /// Every pixel has the same value.
    #[error("all pixels have the value {value}: there is nothing to see")]
    Constant {
        /// The value.
        value: f64,
    },
}

impl PictureFault {
    /// What to do about it.
    pub fn mend(&self) -> &'static str {
        match self {
            Self::File(TextureFault::Foreign(_)) => "convert it to FITS, PNG or EXR",
            Self::File(fault) => fault.mend(),
            Self::NoImage | Self::NoPixels | Self::Axes(_) | Self::NoChannels => {
                "give a file with one picture of brightness"
            }
            Self::Damaged(_) => "fetch or export the picture again",
            Self::TooLarge { .. } => "scale the picture down or cut it out",
            Self::NotSquare(..) => "resample it to square pixels",
            Self::Count { .. } => "give one value for each pixel",
            Self::NotFinite { .. } => "fill these pixels, or cut the picture so that they are outside",
            Self::Constant { .. } => "check the exposure, and that it is the right file",
        }
    }
}

fn foreign(fault: &TextureFault) -> String {
    match fault {
        TextureFault::Foreign(name) => {
            let but = name.as_ref().map(|n| format!(" but {n}")).unwrap_or_default();
            format!("it is not a FITS, EXR, PNG, JPEG, TIFF, WebP or HDR file{but}")
        }
        other => other.to_string(),
    }
}
