//! What the WebP decoder does not notice.

/// A WebP file without what may stand behind it; nothing if a part of it is cut off.
///
/// Container specification, "RIFF File Format": the file is one chunk, `RIFF`, of `WEBP` and
/// further chunks. A chunk is four letters, a length in four bytes, the least first, and as many
/// bytes, filled up to an even number. The decoder takes the memory that a length asks for before
/// it looks whether there is as much.
pub(super) fn whole(bytes: &[u8]) -> Option<&[u8]> {
    let length = |at: usize| {
        let length = bytes.get(at + 4..at + 8)?.try_into().ok()?;
        usize::try_from(u32::from_le_bytes(length)).ok()
    };
    let file = &bytes[..bytes.len().min(8 + length(0)?)];
    let mut at = 12;
    while at + 8 <= file.len() {
        let end = at + 8 + length(at)?;
        if end > file.len() {
            return None;
        }
        at = end.next_multiple_of(2);
    }
    Some(file)
}
