"""A locked file that says that a process is at work. The system releases the lock however the process ends."""
import contextlib
import errno
import fcntl
import os
import time
from collections.abc import Iterator

from json_files import Refused

EXCLUSIVE, SHARED = fcntl.LOCK_EX, fcntl.LOCK_SH
PAUSE_S = 0.05


@contextlib.contextmanager
def locked(path: str, kind: int, subject: str, patience_s: float = 1, remove: bool = False) -> Iterator[None]:
    """Holds the lock, and with `remove` removes the file in the end, which is for exclusive locks only. Waits for a process that
    has it, since the system takes a moment to end one that was killed, then raises Refused, as where the file cannot be made;
    the sentence speaks of `subject`, what is locked in the user's words. Where a file system has no locks, nobody is kept out."""
    descriptor = taken(path, kind, subject, time.monotonic() + patience_s)
    try:
        yield
    finally:
        if remove:
            with contextlib.suppress(OSError):
                os.unlink(path)
        os.close(descriptor)


def taken(path: str, kind: int, subject: str, until: float) -> int:
    while True:
        try:
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW, 0o666)
        except OSError as error:
            raise Refused(f"{subject} cannot be written: {error.strerror}") from error
        try:
            fcntl.flock(descriptor, kind | fcntl.LOCK_NB)
            is_held = False
        except OSError as error:
            is_held = error.errno in (errno.EWOULDBLOCK, errno.EINTR)
            if not is_held:
                return descriptor
        if not is_held and names(path, descriptor):
            return descriptor
        os.close(descriptor)
        if is_held:
            if time.monotonic() >= until:
                raise Refused(f"{subject} is being written by another process")
            time.sleep(PAUSE_S)


def names(path: str, descriptor: int) -> bool:
    """Whether the path still names the open file: a process that ends may have removed it since it was opened."""
    try:
        return os.path.samestat(os.stat(path), os.fstat(descriptor))
    except OSError:
        return False
