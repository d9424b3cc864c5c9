//! Work that survives an interruption: finished parts of it in a file, to go on from.
//!
//! Any work that comes in numbered parts (the tiles of a picture, the frames of a film, the
//! chains of a fit) appends each finished part to a log. The log says what work it belongs to, so
//! that it is never mixed with another. A part that was cut off as it was written is noticed by
//! its checksum and done again.
//!
//! ```text
//! file    "kerrscpt"  version byte  record of the identity  record of a part …
//! record  length of the payload, u32 LE   payload   first 8 bytes of the payload's BLAKE3
//! part    number, u64 LE   contents
//! ```
//!
//! A part is on the disk half a second after it was handed in at the latest, or when the next
//! one is. The file is locked as long as its owner lives; it is deleted by [`Checkpoint::remove`].

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::output::FileError;
use crate::scene::Scene;
use crate::spacetime::Level;

const MAGIC: &[u8; 8] = b"kerrscpt";

/// Version of the file format, and of what the parts hold.
const VERSION: u8 = 3;

/// Finished parts wait no longer than this for the next one before they are written.
const PATIENCE: Duration = Duration::from_millis(500);

/// What work a checkpoint belongs to. Parts of equal identities are interchangeable.
#[derive(Clone, Debug, Deserialize, Eq, PartialEq, Serialize)]
pub struct Identity {
    /// Version of the program.
    pub program: String,
    /// The machine instructions that the work is done with.
    pub instruction_level: String,
    /// BLAKE3 of all that the work depends on.
    pub work: [u8; 32],
}

impl Identity {
    /// That of the work of drawing a scene with a level of instructions: all of the scene, and the contents of its
    /// pictures.
    ///
    /// # Errors
    /// If a picture cannot be read.
    pub fn of_render(scene: &Scene, level: Level) -> Result<Self, FileError> {
        let mut hasher = blake3::Hasher::new();
        hasher.update(b"render\0").update(scene.to_toml().as_bytes());
        for path in scene.pictures() {
            hasher.update(b"\0");
            let file = File::open(path).and_then(|file| hasher.update_reader(file).map(|_| ()));
            file.map_err(|e| FileError::read(path, &e))?;
        }
        Ok(Self::hashed(level, &hasher))
    }

    /// That of work of a kind which depends on these bytes alone.
    pub fn of_work(kind: &str, level: Level, parts: &[&[u8]]) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(kind.as_bytes()).update(b"\0");
        for part in parts {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
        Self::hashed(level, &hasher)
    }

    fn hashed(level: Level, hasher: &blake3::Hasher) -> Self {
        Self {
            program: env!("CARGO_PKG_VERSION").to_owned(),
            instruction_level: level.name().to_owned(),
            work: *hasher.finalize().as_bytes(),
        }
    }
}

/// Why a checkpoint cannot be gone on from.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// The file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// It is a checkpoint of something else, or none.
    #[error("cannot go on from {}: {reason}; leave out --resume to start afresh", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What it is instead.
        reason: String,
    },
    /// Another process is at work on it.
    #[error("{} is in use by another process; wait for it, or choose another output file", .0.display())]
    InUse(PathBuf),
}

/// A log of finished parts.
///
/// ```
/// use kerrscope::checkpoint::{Checkpoint, Identity};
/// # let folder = tempfile::tempdir()?;
/// let path = folder.path().join("work.checkpoint");
/// let identity =
///     Identity { program: "1.0".into(), instruction_level: "baseline".into(), work: [7; 32] };
/// let first = Checkpoint::start(&path, &identity)?;
/// first.keep(3, b"done")?;
/// first.flush()?;
/// drop(first); // interrupted here
///
/// let again = Checkpoint::resume(&path, &identity)?;
/// let mut parts = Vec::new();
/// again.parts(|number, contents| parts.push((number, contents.to_vec())))?;
/// assert_eq!(parts, [(3, b"done".to_vec())]);
/// again.remove()?;
/// assert!(!path.exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Checkpoint {
    path: PathBuf,
    log: Mutex<Log>,
}

#[derive(Debug)]
struct Log {
    /// The file, once there is something in it.
    file: Option<File>,
    /// What is still to be written.
    waiting: Vec<u8>,
    /// When the file was last written.
    written: Instant,
    /// End of the header and of the last whole record in the file.
    extent: [u64; 2],
}

impl Checkpoint {
    /// A checkpoint of work that begins. A file of an earlier one is replaced as soon as
    /// there is something to keep.
    ///
    /// # Errors
    /// If another process is at work on the file.
    pub fn start(path: &Path, identity: &Identity) -> Result<Self, CheckpointError> {
        match File::open(path) {
            Ok(file) => lock(&file, path)?,
            Err(e) if e.kind() == io::ErrorKind::NotFound => {}
            Err(e) => return Err(FileError::read(path, &e).into()),
        }
        let mut waiting = MAGIC.to_vec();
        waiting.push(VERSION);
        append(&mut waiting, &encode(identity));
        let extent = [waiting.len() as u64; 2];
        let log = Log { file: None, waiting, written: Instant::now(), extent };
        Ok(Self { path: path.to_path_buf(), log: Mutex::new(log) })
    }

    /// The checkpoint in a file; if there is none, that of work that begins.
    ///
    /// # Errors
    /// If the file cannot be read, or belongs to other work or another version.
    pub fn resume(path: &Path, identity: &Identity) -> Result<Self, CheckpointError> {
        let mut file = match OpenOptions::new().read(true).write(true).open(path) {
            Ok(file) => file,
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Self::start(path, identity),
            Err(e) => return Err(FileError::read(path, &e).into()),
        };
        lock(&file, path)?;
        let failed = |e: io::Error| FileError::read(path, &e);
        let extent = extent(&mut file, identity).map_err(failed)?;
        let extent =
            extent.map_err(|reason| CheckpointError::Foreign { path: path.to_path_buf(), reason })?;
        // What was being written when it ended is cut off.
        file.set_len(extent[1]).map_err(|e| FileError::write(path, &e))?;
        file.seek(SeekFrom::End(0)).map_err(failed)?;
        let log = Log { file: Some(file), waiting: Vec::new(), written: Instant::now(), extent };
        Ok(Self { path: path.to_path_buf(), log: Mutex::new(log) })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Tells the finished parts that the file held when it was opened, in the order in which they
    /// were kept.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn parts(&self, mut each: impl FnMut(u64, &[u8])) -> Result<(), FileError> {
        let mut log = self.lock();
        let [start, end] = log.extent;
        let Some(file) = &mut log.file else { return Ok(()) };
        let mut read = || -> io::Result<()> {
            file.seek(SeekFrom::Start(start))?;
            let mut rest = BufReader::new(&*file).take(end - start);
            while let Some(payload) = record(&mut rest)? {
                if let Some((number, contents)) = payload.split_first_chunk() {
                    each(u64::from_le_bytes(*number), contents);
                }
            }
            file.seek(SeekFrom::End(0)).map(|_| ())
        };
        read().map_err(|e| FileError::read(&self.path, &e))
    }

    /// Keeps a finished part.
    ///
    /// # Errors
    /// If the file cannot be written, as on a full disk. The parts in it before are still there.
    pub fn keep(&self, number: u64, contents: &[u8]) -> Result<(), FileError> {
        let mut log = self.lock();
        append(&mut log.waiting, &[&number.to_le_bytes(), contents].concat());
        if log.written.elapsed() < PATIENCE { Ok(()) } else { self.write(&mut log) }
    }

    /// Writes what waits to be written.
    ///
    /// # Errors
    /// As [`Checkpoint::keep`].
    pub fn flush(&self) -> Result<(), FileError> {
        self.write(&mut self.lock())
    }

    /// Deletes the file: the work is done.
    ///
    /// # Errors
    /// If it cannot be deleted.
    pub fn remove(self) -> Result<(), FileError> {
        if self.lock().file.is_none() {
            return Ok(());
        }
        std::fs::remove_file(&self.path).map_err(|e| FileError::write(&self.path, &e))
    }

    fn write(&self, log: &mut Log) -> Result<(), FileError> {
        if log.waiting.is_empty() {
            return Ok(());
        }
        let write = |log: &mut Log| -> io::Result<()> {
            let file = match &mut log.file {
                Some(file) => file,
                None => log.file.insert(create(&self.path)?),
            };
            file.write_all(&log.waiting)?;
            // A power cut costs no more than a kill.
            file.sync_data()
        };
        write(log).map_err(|e| FileError::write(&self.path, &e))?;
        log.waiting.clear();
        log.written = Instant::now();
        Ok(())
    }

    fn lock(&self) -> MutexGuard<'_, Log> {
        self.log.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// An empty file that is ours.
fn create(path: &Path) -> io::Result<File> {
    let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
    file.try_lock()?;
    if file.metadata()?.is_file() {
        file.set_len(0)?;
    }
    Ok(file)
}

fn lock(file: &File, path: &Path) -> Result<(), CheckpointError> {
    match file.try_lock() {
        Ok(()) => Ok(()),
        Err(TryLockError::WouldBlock) => Err(CheckpointError::InUse(path.to_path_buf())),
        Err(TryLockError::Error(e)) => Err(FileError::read(path, &e).into()),
    }
}

/// Ends of the header and of the last whole record, or what the file is instead.
fn extent(file: &mut File, identity: &Identity) -> io::Result<Result<[u64; 2], String>> {
    let length = file.metadata()?.len();
    let mut rest = BufReader::new(file).take(length);
    let mut head = [0; MAGIC.len() + 1];
    let foreign = || Ok(Err("it is no checkpoint".to_owned()));
    if length < head.len() as u64 {
        return foreign();
    }
    rest.read_exact(&mut head)?;
    let Some(version) = head.strip_prefix(MAGIC) else { return foreign() };
    if version != [VERSION] {
        return Ok(Err(format!("it has version {} of the format, and this is {VERSION}", version[0])));
    }
    let Some(made) = record(&mut rest)?.and_then(|payload| postcard::from_bytes::<Identity>(&payload).ok())
    else {
        return Ok(Err("it is damaged".to_owned()));
    };
    let difference = if made.program != identity.program {
        Some(format!("it was made by kerrscope {}, and this is {}", made.program, identity.program))
    } else if made.instruction_level != identity.instruction_level {
        let (then, now) = (made.instruction_level, &identity.instruction_level);
        Some(format!("it was made with the instructions {then}, and these are {now}"))
    } else if made.work == identity.work {
        None
    } else {
        Some("it belongs to another scene".to_owned())
    };
    if let Some(difference) = difference {
        return Ok(Err(difference));
    }
    let header = length - rest.limit();
    let mut end = header;
    while record(&mut rest)?.is_some() {
        end = length - rest.limit();
    }
    Ok(Ok([header, end]))
}

fn encode(identity: &Identity) -> Vec<u8> {
    postcard::to_stdvec(identity).unwrap_or_default()
}

fn checksum(payload: &[u8]) -> [u8; 8] {
    let hash = blake3::hash(payload);
    std::array::from_fn(|i| hash.as_bytes()[i])
}

fn append(to: &mut Vec<u8>, payload: &[u8]) {
    let length = u32::try_from(payload.len()).unwrap_or(u32::MAX);
    to.extend(length.to_le_bytes());
    to.extend(payload);
    to.extend(checksum(payload));
}

/// The next record, if it is whole.
fn record(from: &mut io::Take<impl Read>) -> io::Result<Option<Vec<u8>>> {
    let mut length = [0; 4];
    if from.limit() < 12 {
        return Ok(None);
    }
    from.read_exact(&mut length)?;
    let length = u64::from(u32::from_le_bytes(length));
    if length + 8 > from.limit() {
        return Ok(None);
    }
    let mut payload = vec![0; length as usize];
    from.read_exact(&mut payload)?;
    let mut check = [0; 8];
    from.read_exact(&mut check)?;
    Ok((check == checksum(&payload)).then_some(payload))
}
