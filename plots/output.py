"""Every file that plots write: checked before it is made, and replaced as a whole. As harness/record/output.h does it in C++."""
import errno
import os
import pathlib
import re
import signal
import stat
import sys
import tempfile
import unicodedata
from collections.abc import Callable, Iterable
from typing import TextIO

from results import Refused

OF_200_DPI = b"\x00\x00\x00\tpHYs\x00\x00\x1e\xc2\x00\x00\x1e\xc2\x01"  # in a PNG: 7,874 dots a metre
HEAD_BYTES = 4096


class WrongUsage(Exception):
    """A file that must not be replaced; the text says which and why."""


def is_page(head: bytes) -> bool:
    return head.startswith(b"<!DOCTYPE html>") and b"bvhbench" in head


def is_picture(head: bytes) -> bool:
    """Whether it may be a picture by style.save: those of older versions say no more of who made them."""
    return (head.startswith(b"\x89PNG") and OF_200_DPI in head[:128]) or (b"<svg " in head and b"<g id=\"figure_1\">" in head)


def check(path: pathlib.Path, inputs: Iterable[pathlib.Path], force: bool, is_ours: Callable[[bytes], bool]) -> None:
    """Raises WrongUsage for a folder, for a file that is read too, and, without `force`, for one that somebody else made."""
    if path.is_dir():
        raise WrongUsage(f"{path} is a folder; name a file in it")
    if not path.is_file() or standard_stream(path.stat()):
        return
    if any(other.exists() and path.samefile(other) for other in inputs):
        raise WrongUsage(f"{path} is read by this command; it is not replaced, choose another file")
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
    if head and not force and not is_ours(head):
        raise WrongUsage(f"{path} is there already; --force replaces it, or choose another file")


def check_pictures(folder: pathlib.Path, inputs: Iterable[pathlib.Path], force: bool) -> None:
    """Raises WrongUsage, before anything is drawn into the folder, if a file there is called like a picture and is none of ours,
    or is an input."""
    files = [path for path in inputs if not path.is_dir()]
    for path in sorted(folder.iterdir()):
        if path.suffix in (".png", ".svg"):
            check(path, files, force, lambda head: head.startswith(b"\x89PNG") or b"<svg" in head)


def make_folder(folder: pathlib.Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Refused(f"the folder {folder} cannot be made: {error.strerror}") from error


def write(path: pathlib.Path | str, content: bytes) -> bool:
    """Links are followed; devices, pipes and this process's standard output are written to as they are, and False is returned.
    Raises Refused with the system's reason; then an earlier file stays."""
    path = pathlib.Path(path)
    try:
        about = path.stat() if path.exists() else None
        if about and (stream := standard_stream(about)):
            stream.buffer.write(content)
            stream.flush()
            return False
        if about and not stat.S_ISREG(about.st_mode):
            path.write_bytes(content)
            return False
        replace(pathlib.Path(os.path.realpath(path)), content, about)
        return True
    except OSError as error:
        raise Refused(f"{path} cannot be written: {error.strerror or error}") from error


def standard_stream(about: os.stat_result) -> TextIO | None:
    return next((stream for stream in (sys.stdout, sys.stderr) if os.path.samestat(os.fstat(stream.fileno()), about)), None)


def replace(target: pathlib.Path, content: bytes, about: os.stat_result | None) -> None:
    """Through a file beside it, which gets its mode and owner, or those of a new file."""
    if about and not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    descriptor, name = tempfile.mkstemp(prefix=f"{target.name}.tmp", dir=target.parent)
    try:
        with os.fdopen(descriptor, "wb") as file:
            take_mode(descriptor, about)
            file.write(content)
            file.flush()
            os.fsync(descriptor)
        os.rename(name, target)
    except BaseException:
        os.unlink(name)
        raise
    folder = os.open(target.parent, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(folder)
    except OSError:
        pass  # a file system that cannot sync a folder has renamed the file all the same
    finally:
        os.close(folder)


def take_mode(descriptor: int, about: os.stat_result | None) -> None:
    if about is None:
        mask = os.umask(0)
        os.umask(mask)
        os.fchmod(descriptor, 0o666 & ~mask)
        return
    try:
        os.fchown(descriptor, about.st_uid, about.st_gid)
    except PermissionError:
        pass  # only root may give a file away; for others it is theirs already, or becomes theirs
    os.fchmod(descriptor, stat.S_IMODE(about.st_mode))


def to_an_end(main: Callable[[], int], prefix: str = "") -> int:
    """What a script exits with: that of `main`, or, with a sentence, 2 for wrong usage and 3 for what cannot be read, drawn or
    written."""
    prepare_streams()
    try:
        status = main()
        sys.stdout.flush()
        return status
    except WrongUsage as wrong:
        say(f"{prefix}{wrong}")
        return 2
    except Refused as refusal:
        say(f"{prefix}{refusal}")
    except MemoryError:
        say(f"{prefix}there is too little memory")
    except BrokenPipeError:  # nobody reads what is printed any more
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGPIPE)
    except OSError as error:
        say(f"{prefix}standard output cannot be written: {error.strerror}")
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is left in its buffer
    return 3


def prepare_streams() -> None:
    """One that was closed is there again: standard output then cannot be written. Control characters are spelled out."""
    sys.stdout = sys.stdout or os.fdopen(os.open(os.devnull, os.O_RDONLY), "w")
    sys.stderr = sys.stderr or os.fdopen(os.open(os.devnull, os.O_WRONLY), "w")
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="surrogateescape")  # in any locale; names of files are bytes
    write = sys.stdout.write
    sys.stdout.write = lambda text: write(printable(text))


def described(error: Exception) -> str:
    """What an error says, for a sentence."""
    if isinstance(error, KeyError):
        return f"it has no {error}"
    return f"{error}" or type(error).__name__


def printable(text: str) -> str:
    """With control characters but the ends of lines and tabs spelled out: a terminal obeys them."""
    return re.sub(r"[\x00-\x08\x0b-\x1f\x7f]", lambda letter: f"\\x{ord(letter[0]):02x}", text)


def say(sentence: str) -> None:
    """On standard error, in one line, control characters spelled out: a terminal obeys them."""
    print("".join(repr(letter)[1:-1] if unicodedata.category(letter) == "Cc" else letter for letter in sentence), file=sys.stderr)
