"""Checks and reserves the output files of a command before it does anything, until the command ends."""
import contextlib
import os
import stat
from collections.abc import Callable, Iterable, Iterator

from . import documents, file_lock
from .json_files import Refused
from .output import WrongUsage, standard_stream

MOST_LINKS = 40  # Linux's limit


@contextlib.contextmanager
def reserved(path: str, option: str, force: bool, inputs: Iterable[str] = (),
             may_replace: Callable[[bytes], bool] = lambda _text: False) -> Iterator[None]:
    """Prevents other processes from writing the file. Raises WrongUsage if it is a folder, a packed file, one of the inputs, or
    an earlier file, unless `force` is true or `may_replace` returns true for its text. Raises Refused if it cannot be written or
    another process has reserved it. Creates no folder. Devices, pipes and standard output are not reserved."""
    if os.path.isdir(path):
        raise WrongUsage(f"{option}: {path} is a folder; name a file in it")
    if os.path.splitext(path)[1] == ".xz":
        raise WrongUsage(f"{option}: {path} is not written packed; write it without .xz and pack it with xz")
    if not is_replaced(path):
        yield
        return
    target = without_links(path)
    folder = os.path.dirname(target) or "."
    require_writable(path, target, folder)
    lock = os.path.join(folder, f".{os.path.basename(target)}.lock")
    with file_lock.locked(lock, path):
        if os.path.exists(target) and os.path.getsize(target) > 0:  # the last lock holder may have written it
            check_earlier(path, target, option, inputs, force, may_replace)
        yield


def is_replaced(path: str) -> bool:
    """True if the file is replaced as a whole. False for a device or pipe, which is written in place."""
    try:
        about = os.stat(path)
    except OSError:
        return True
    return stat.S_ISREG(about.st_mode) and standard_stream(about) is None


def without_links(path: str) -> str:
    """Returns the file that a path names after all links. The file need not exist."""
    for _ in range(MOST_LINKS):
        if not os.path.islink(path):
            return path
        path = os.path.join(os.path.dirname(path), os.readlink(path))
    raise Refused(f"{path} cannot be written: too many links")


def require_writable(path: str, target: str, folder: str) -> None:
    if not os.path.isdir(folder):
        raise Refused(f"{path} cannot be written: there is no folder {folder}")
    if (os.path.exists(target) and not os.access(target, os.W_OK)) or not os.access(folder, os.W_OK | os.X_OK):
        raise Refused(f"{path} cannot be written: Permission denied")


def check_earlier(path: str, target: str, option: str, inputs: Iterable[str], force: bool,
                  may_replace: Callable[[bytes], bool]) -> None:
    if any(is_input(target, other) for other in inputs):
        raise WrongUsage(f"{option}: {path} is read by this command; it is not replaced, choose another file")
    if force:
        return
    text = documents.file_text(target, "the earlier file")
    if not may_replace(text):
        raise WrongUsage(f"{option}: {path} {contents_of(text, path)}; --force replaces it, or choose another file")


def is_input(target: str, other: str) -> bool:
    """True if the existing file is `other`, or lies in the folder `other`."""
    if not os.path.exists(other):
        return False
    inside, folder = os.path.realpath(target), os.path.realpath(other)
    return os.path.samefile(target, other) or (os.path.isdir(folder) and os.path.commonpath((inside, folder)) == folder)


def contents_of(text: bytes, path: str) -> str:
    """Returns "is a result of 3 cells", or another description."""
    try:
        document = documents.document_of(text, path)
    except Refused:
        return "is there already"
    count = len(document["cells"]) + len(document.get("stress", []))
    return f"is a result of {count} cell{'' if count == 1 else 's'}"
