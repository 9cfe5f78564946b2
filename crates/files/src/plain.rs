//! Plain files and folders: nothing is written through a symbolic link that lies where the program makes its
//! own files, and nothing is opened for reading that is no file.
//!
//! A folder of results may come from somebody else. A link in it under the name of a file that is to be
//! written would lead the program elsewhere; a named pipe or a device would keep it waiting. Files are
//! therefore made new (`O_EXCL`, which follows no link), taken up again only as what they are (`O_NOFOLLOW`),
//! and looked at before they are read. The folder that the user has named may be a link: that is the user's
//! own doing. What changes between a look and a write is not guarded against: somebody who may write into the
//! folder while the program does can write there anyway.

use crate::results::messages::{LINK, NO_FILE, REFUSED};
use embate_solver::message::Message;
use std::fmt;
use std::fs::{self, File, FileType, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// What lies at a path in place of a plain file or folder; the inner error of an [`io::Error`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NotPlain {
    /// A link where something is written.
    Link,
    /// Neither file nor folder.
    Special(&'static str),
    /// A folder, or a file in place of one.
    Other(&'static str),
}

impl fmt::Display for NotPlain {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Link => out.write_str(
                "it is a symbolic link, and nothing is written through one here; remove the link, or choose another folder with --out",
            ),
            Self::Special(what) => write!(out, "it is a {what}, not a file; remove it, or put the file in its place"),
            Self::Other(what) => write!(out, "it is a {what}; remove it, or choose another folder with --out"),
        }
    }
}

impl std::error::Error for NotPlain {}

impl From<NotPlain> for io::Error {
    fn from(what: NotPlain) -> Self {
        Self::other(what)
    }
}

/// Which message an error of this module, or of the system, is.
pub(crate) fn kind(error: &io::Error) -> &'static Message {
    match error.get_ref().and_then(|inner| inner.downcast_ref()) {
        Some(NotPlain::Link) => &LINK,
        Some(NotPlain::Special(_)) => &NO_FILE,
        Some(NotPlain::Other(_)) | None => &REFUSED,
    }
}

/// What is neither file nor folder.
fn special(kind: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return "named pipe";
        }
        if kind.is_socket() {
            return "socket";
        }
        if kind.is_char_device() || kind.is_block_device() {
            return "device";
        }
    }
    let _ = kind;
    "special file"
}

/// The same, opened so that neither a link is followed, with `follows_no_link`, nor a named pipe waits for
/// its other end.
fn quick(options: &mut OpenOptions, follows_no_link: bool) -> &mut OpenOptions {
    #[cfg(unix)]
    {
        use nix::fcntl::OFlag;
        use std::os::unix::fs::OpenOptionsExt;
        let link = if follows_no_link { OFlag::O_NOFOLLOW } else { OFlag::empty() };
        options.custom_flags((OFlag::O_NONBLOCK | link).bits());
    }
    let _ = follows_no_link;
    options
}

/// Refuses what is neither file nor folder; a folder is left to the system's own words.
fn refuse_special(kind: FileType) -> io::Result<()> {
    if kind.is_file() || kind.is_dir() { Ok(()) } else { Err(NotPlain::Special(special(kind)).into()) }
}

/// Opens a file for reading; a link is followed to its end, which must be a file.
///
/// # Errors
/// A named pipe, a socket or a device, which are not opened; what the system says.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    refuse_special(fs::metadata(path)?.file_type())?;
    let file = quick(OpenOptions::new().read(true), false).open(path)?;
    // Once more: it may have changed in between.
    refuse_special(file.metadata()?.file_type())?;
    Ok(file)
}

/// All bytes of a file; see [`open`].
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = open(path)?;
    let mut bytes = Vec::with_capacity(file.metadata().map_or(0, |data| data.len() as usize));
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The text of a file; see [`open`].
pub(crate) fn read_to_string(path: &Path) -> io::Result<String> {
    String::from_utf8(read(path)?).map_err(|_| io::Error::new(ErrorKind::InvalidData, "it is no text"))
}

/// Opens a file that is there, and that the program itself has made: no link is followed.
pub(crate) fn reopen(path: &Path, options: &mut OpenOptions) -> io::Result<File> {
    let kind = fs::symlink_metadata(path)?.file_type();
    if kind.is_symlink() {
        return Err(NotPlain::Link.into());
    }
    refuse_special(kind)?;
    let file = quick(options, true).open(path)?;
    refuse_special(file.metadata()?.file_type())?;
    Ok(file)
}

/// The same of a file that may be missing: then it is made.
pub(crate) fn reopen_or_create(path: &Path, options: &mut OpenOptions) -> io::Result<File> {
    match options.clone().create_new(true).open(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => reopen(path, options),
        made => made,
    }
}

/// How often something is tried that another process comes between.
const TRIES: usize = 8;

/// Makes a new file, which is this process's own as long as it is open. What a program that was killed has
/// left under its name is removed, but only a plain file that no one writes to.
///
/// # Errors
/// A link or anything else in its place; [`ErrorKind::ResourceBusy`] where another process writes to it; what
/// the system says.
pub(crate) fn create(path: &Path) -> io::Result<File> {
    for _ in 0..TRIES {
        match OpenOptions::new().write(true).create_new(true).open(path) {
            Ok(file) => {
                hold(&file)?;
                // Between the two, another process may have taken it for a leftover.
                if is_at(&file, path) {
                    return Ok(file);
                }
            }
            Err(error) if error.kind() == ErrorKind::AlreadyExists => remove_leftover(path)?,
            Err(error) => return Err(error),
        }
    }
    Err(busy())
}

/// Removes a plain file that no one writes to.
fn remove_leftover(path: &Path) -> io::Result<()> {
    let file = match reopen(path, OpenOptions::new().read(true)) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        file => file?,
    };
    if file.metadata()?.is_dir() {
        return Err(NotPlain::Other("folder").into());
    }
    hold(&file)?;
    if is_at(&file, path) { fs::remove_file(path) } else { Ok(()) }
}

fn busy() -> io::Error {
    io::Error::new(ErrorKind::ResourceBusy, "another process writes to it; wait for that, or stop it first")
}

/// Locks a file until it is closed, whatever ends the process.
pub(crate) fn hold(file: &File) -> io::Result<()> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(busy()),
        // Some file systems know no locks.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// Whether an open file is still the one at this path.
pub(crate) fn is_at(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let place = |data: &fs::Metadata| (data.dev(), data.ino());
        matches!((file.metadata(), fs::symlink_metadata(path)), (Ok(own), Ok(there)) if place(&own) == place(&there))
    }
    #[cfg(not(unix))]
    {
        // An open file keeps its name there.
        let _ = file;
        path.exists()
    }
}

/// Whether a folder is there that the program has made itself.
///
/// # Errors
/// A link; what the system says.
pub(crate) fn is_folder(path: &Path) -> io::Result<bool> {
    match fs::symlink_metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
        Ok(data) if data.is_symlink() => Err(NotPlain::Link.into()),
        Ok(data) => Ok(data.is_dir()),
    }
}

/// Makes a folder of the program's own, unless it is there; the folder around it is there.
///
/// # Errors
/// A link or a file in its place; what the system says.
pub(crate) fn folder(path: &Path) -> io::Result<()> {
    match fs::create_dir(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            if is_folder(path)? {
                Ok(())
            } else {
                Err(NotPlain::Other("file, not a folder").into())
            }
        }
        made => made,
    }
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use std::io::Write;
    use std::os::unix::fs::symlink;

    #[test]
    fn what_was_left_is_replaced_and_a_hard_link_of_it_stays_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let [part, other] = ["a.part", "other"].map(|name| folder.path().join(name));
        fs::write(&other, "mine").unwrap();
        fs::hard_link(&other, &part).unwrap();
        create(&part).unwrap().write_all(b"new").unwrap();
        assert_eq!([&part, &other].map(|path| fs::read_to_string(path).unwrap()), ["new", "mine"]);
    }

    #[test]
    fn what_another_one_writes_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let part = folder.path().join("a.part");
        let mut first = create(&part).unwrap();
        assert_eq!(create(&part).unwrap_err().kind(), ErrorKind::ResourceBusy);
        first.write_all(b"first").unwrap();
        assert_eq!(fs::read_to_string(&part).unwrap(), "first");
        drop(first);
        assert!(create(&part).is_ok() && fs::read(&part).unwrap().is_empty());
    }

    #[test]
    fn no_link_is_written_through_whether_its_end_is_there_or_not() {
        let folder = tempfile::tempdir().unwrap();
        let (target, link) = (folder.path().join("target"), folder.path().join("link"));
        symlink(&target, &link).unwrap();
        for is_there in [false, true] {
            if is_there {
                fs::write(&target, "mine").unwrap();
            }
            let options = || OpenOptions::new().read(true).append(true).clone();
            for error in [
                create(&link).unwrap_err(),
                reopen(&link, &mut options()).unwrap_err(),
                reopen_or_create(&link, &mut options()).unwrap_err(),
                is_folder(&link).unwrap_err(),
                super::folder(&link).unwrap_err(),
            ] {
                assert_eq!(kind(&error).code, LINK.code, "{error}");
            }
            assert_eq!(target.exists(), is_there);
        }
        // Reading follows it.
        assert_eq!(read(&link).unwrap(), b"mine");
    }

    #[test]
    fn pipes_sockets_and_devices_are_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let [pipe, socket, device] = ["pipe", "socket", "device"].map(|name| folder.path().join(name));
        nix::unistd::mkfifo(&pipe, nix::sys::stat::Mode::S_IRWXU).unwrap();
        let _listening = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        symlink("/dev/zero", &device).unwrap();
        for (path, what) in [(&pipe, "named pipe"), (&socket, "socket"), (&device, "device")] {
            let error = read(path).unwrap_err();
            assert!(kind(&error).code == NO_FILE.code && error.to_string().contains(what), "{error}");
        }
        for path in [&pipe, &socket] {
            for error in [create(path).unwrap_err(), reopen_or_create(path, OpenOptions::new().write(true)).unwrap_err()] {
                assert_eq!(kind(&error).code, NO_FILE.code, "{error}");
            }
        }
    }
}
