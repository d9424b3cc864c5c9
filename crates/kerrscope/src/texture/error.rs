//! Picture files that cannot be used, and why.

use std::io;
use std::path::PathBuf;

use image::error::ImageError;

/// A picture file that cannot be used, and why.
#[derive(Debug, thiserror::Error)]
#[error("cannot use {} as a picture: {fault}; {}", path.display(), fault.mend())]
pub struct TextureError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub fault: TextureFault,
}

/// What can be wrong with a picture file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TextureFault {
    /// The file cannot be read.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// The file has no contents.
    #[error("the file is empty")]
    Empty,
    /// The file is in another format, named if it is known.
    #[error("it is not a PNG, JPEG, TIFF, WebP, HDR or EXR file{}", .0.as_ref().map(|n| format!(" but {n}")).unwrap_or_default())]
    Foreign(Option<String>),
    /// The format's way of saying this is not known here.
    #[error("it is of a kind that cannot be read ({0})")]
    Unsupported(String),
    /// The file ends before the picture does.
    #[error("the file ends before the picture does")]
    Truncated,
    /// The contents contradict themselves.
    #[error("the file is damaged ({0})")]
    Damaged(String),
    /// The picture is larger than this program takes.
    #[error(
        "{width}×{height} pixels of {mebibytes} MiB are more than a picture may have: \
         as many as 16384×8192, 65536 along an edge, and 768 MiB"
    )]
    TooLarge {
        /// Pixels along the top edge.
        width: u32,
        /// Pixels along the left edge.
        height: u32,
        /// What they take, in units of 2^20 bytes.
        mebibytes: u64,
    },
    /// The file itself is larger than this program takes.
    #[error("the file has more than 1 GiB")]
    FileTooLarge,
}

impl TextureFault {
    pub(super) fn from_image(error: ImageError) -> Self {
        match error {
            ImageError::IoError(e) if e.kind() == io::ErrorKind::UnexpectedEof => Self::Truncated,
            // The decoders read from memory: it is not the disk that is at fault.
            ImageError::IoError(e) => Self::Damaged(e.to_string()),
            ImageError::Unsupported(e) => Self::Unsupported(e.to_string()),
            other => Self::Damaged(other.to_string()),
        }
    }

    /// What to do about it.
    pub fn mend(&self) -> &'static str {
        match self {
            Self::Io(e) => match e.kind() {
                io::ErrorKind::NotFound => "check the path",
                io::ErrorKind::PermissionDenied => "make the file readable",
                io::ErrorKind::IsADirectory => "give a file in that folder",
                _ => "check the file and the disk that it is on",
            },
            Self::Foreign(_) => "convert it to PNG, JPEG or EXR",
            Self::Unsupported(_) => "export it as RGB, in 8 or 16 bits",
            Self::Empty | Self::Truncated | Self::Damaged(_) => "fetch or export the picture again",
            Self::TooLarge { .. } | Self::FileTooLarge => "scale the picture down",
        }
    }
}
