//! Rounds of a fit's chains, kept so that it can be gone on with.

use std::path::Path;
use std::sync::Mutex;

use kerrscope::checkpoint::{Checkpoint, CheckpointError, Identity};
use kerrscope::spacetime::Level;
use kerrscope_fit::fit::Keeper;
use kerrscope_fit::task::Ready;

use super::Arguments;
use crate::report::Failure;

/// Rounds of chains in a checkpoint.
pub struct Kept {
    /// The checkpoint.
    pub checkpoint: Checkpoint,
    before: Mutex<Vec<(u64, Vec<u8>)>>,
}

impl Keeper for Kept {
    fn kept(&self, round: u64) -> Option<Vec<u8>> {
        let before = self.before.lock().ok()?;
        before.iter().find(|(number, _)| *number == round).map(|(_, contents)| contents.clone())
    }

    fn keep(&self, round: u64, contents: &[u8]) -> Result<(), String> {
        self.checkpoint
            .keep(round, contents)
            .and_then(|()| self.checkpoint.flush())
            .map_err(|e| e.to_string())
    }
}

/// The checkpoint beside the files to write.
pub fn kept(arguments: &Arguments, name: &Path, ready: &Ready) -> Result<Kept, Failure> {
    let (image, task) = (ready.image(), ready.task());
    let mut path = name.as_os_str().to_owned();
    path.push(".checkpoint");
    let bytes: Vec<u8> = image.values.iter().flat_map(|value| value.to_le_bytes()).collect();
    let settings = format!(
        "{:?} {:?} {:?} {:?} {:?} {:?} {} {:?}",
        image.size,
        task.request,
        task.choice.name,
        arguments.projection,
        arguments.orders,
        arguments.noise,
        arguments.seed,
        task.question.as_ref().map(|question| &question.tested.theory)
    );
    let identity = Identity::of_work("fit", Level::best(), &[settings.as_bytes(), &bytes]);
    let path = Path::new(&path);
    let opened = if arguments.resume {
        Checkpoint::resume(path, &identity)
    } else {
        Checkpoint::start(path, &identity)
    };
    let checkpoint = opened.map_err(|error| match error {
        CheckpointError::File(e) => Failure::Failed(e.to_string()),
        wrong => Failure::Input(wrong.to_string()),
    })?;
    let mut before = Vec::new();
    checkpoint
        .parts(|number, contents| before.push((number, contents.to_vec())))
        .map_err(|e| Failure::Failed(e.to_string()))?;
    Ok(Kept { checkpoint, before: Mutex::new(before) })
}
