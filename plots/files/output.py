"""Writes every file that the plots make: checks the target first, then replaces it as a whole. harness/record/output.h is the C++
counterpart."""
import errno
import os
import pathlib
import re
import signal
import stat
import sys
import tempfile
import traceback
from collections.abc import Callable, Iterable
from typing import TextIO

from ..words import terminal
from .json_files import Refused

OF_200_DPI = b"\x00\x00\x00\tpHYs\x00\x00\x1e\xc2\x00\x00\x1e\xc2\x01"  # in a PNG: 7,874 dots a metre
HEAD_BYTES = 4096
OBEYED = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\udc80-\udc9f]")


class WrongUsage(Exception):
    """A file that must not be replaced; the text says which and why."""


def is_page(head: bytes) -> bool:
    return head.startswith(b"<!DOCTYPE html>") and b"bvhbench" in head


def is_picture(head: bytes) -> bool:
    """True if the file may be a picture by style.save. Pictures of older versions carry no further mark."""
    return (head.startswith(b"\x89PNG") and OF_200_DPI in head[:1024]) or (b"<svg " in head and b"<g id=\"figure_1\">" in head)


def check(path: pathlib.Path, inputs: Iterable[pathlib.Path], force: bool, is_ours: Callable[[bytes], bool]) -> None:
    """Raises WrongUsage for a folder, for an input file, and, without `force`, for a file that this program did not write."""
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
    """Raises WrongUsage, before anything is drawn, if a file in the folder has a picture's name and is an input or no picture."""
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
    """Replaces the file and returns True. Follows links. Writes to devices, pipes and this process's standard output in place and
    returns False. Raises Refused with the system's reason; an earlier file is then kept."""
    path = pathlib.Path(path)
    try:
        about = path.stat() if path.exists() else None
        if about and (stream := standard_stream(about)):
            stream.buffer.write(shown(content) if stream.isatty() else content)
            stream.flush()
            return False
        if about and not stat.S_ISREG(about.st_mode):
            path.write_bytes(content)
            return False
        replace(pathlib.Path(os.path.realpath(path)), content, about)
        return True
    except OSError as error:
        raise Refused(f"{path} cannot be written: {error.strerror or error}") from error


def shown(content: bytes) -> bytes:
    return printable(content.decode("utf-8", "surrogateescape")).encode("utf-8", "surrogateescape")


def standard_stream(about: os.stat_result) -> TextIO | None:
    return next((stream for stream in (sys.stdout, sys.stderr) if os.path.samestat(os.fstat(stream.fileno()), about)), None)


def replace(target: pathlib.Path, content: bytes, about: os.stat_result | None) -> None:
    """Writes a temporary file next to the target and renames it. It gets the target's mode and owner, or those of a new file."""
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
        pass  # a file system that cannot sync a folder has still renamed the file
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
        pass  # only root can change a file's owner; otherwise the file belongs, or will belong, to this user
    os.fchmod(descriptor, stat.S_IMODE(about.st_mode))


def to_an_end(main: Callable[[], int], prefix: str = "") -> int:
    """Runs `main` and returns its exit code, or 2 for wrong usage and 3 for what cannot be read, drawn or written, with a
    message."""
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
    except BrokenPipeError:  # the reader of standard output has closed it
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGPIPE)
    except ModuleNotFoundError as error:
        say(f"{prefix}{sys.executable} has no module {error.name}")
    except ImportError as error:
        say(f"{prefix}a module of {sys.executable} does not start: {described(error)}")
    except OSError as error:
        say(f"{prefix}standard output cannot be written: {error.strerror}")
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # discards the rest of its buffer
    except Exception as error:  # no reader foresaw it: the file is malformed in a new way, or the command has a defect
        place = traceback.extract_tb(error.__traceback__)[-1]  # in this program
        where = f"{pathlib.Path(place.filename).name}:{place.lineno}"
        say(f"{prefix}what was read cannot be used: {type(error).__name__}, {described(error)} ({where})")
    return 3


def prepare_streams() -> None:
    """Replaces closed standard streams, so that writing to standard output fails, and spells out control characters."""
    sys.stdout = sys.stdout or os.fdopen(os.open(os.devnull, os.O_RDONLY), "w")
    sys.stderr = sys.stderr or os.fdopen(os.open(os.devnull, os.O_WRONLY), "w")
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="surrogateescape")  # in any locale; file names may be any bytes
    write = sys.stdout.write
    sys.stdout.write = lambda text: write(terminal.with_codes(printable(text)))


def described(error: Exception) -> str:
    """Returns an error's text for use in a message."""
    if isinstance(error, KeyError):
        return f"it has no {error}"
    return f"{error}" or type(error).__name__


def printable(text: str) -> str:
    """Spells out control characters except newlines and tabs, and changes of the direction of writing, because a terminal would
    obey them. Bytes that are no text are control characters too (surrogateescape)."""
    return OBEYED.sub(lambda letter: f"\\u{ord(letter[0]):04x}" if "\u2000" < letter[0] < "\ud800" else f"\\x{ord(letter[0]) & 0xff:02x}", text)


def say(sentence: str) -> None:
    """Prints a message to standard error in one line, without control characters."""
    print(printable(sentence).replace("\n", "\\n").replace("\t", "\\t"), file=sys.stderr)
