"""A lock file that marks a running process. The system releases the lock however the process ends."""
import contextlib
import errno
import fcntl
import os
import time
from collections.abc import Iterator

from .json_files import Refused

PATIENCE_S, PAUSE_S = 1, 0.05


@contextlib.contextmanager
def locked(path: str, subject: str) -> Iterator[None]:
    """Holds a lock on `path`, and deletes the file at the end. Retries for PATIENCE_S while another process holds the lock, since the system takes a moment to end a killed process. Raises Refused after that, or
    if the file cannot be created; the message names `subject`. A file system without locks excludes no other process."""
    descriptor = taken(path, subject, time.monotonic() + PATIENCE_S)
    try:
        yield
    finally:
        with contextlib.suppress(OSError):
            os.unlink(path)
        os.close(descriptor)


def taken(path: str, subject: str, until: float) -> int:
    while True:
        try:
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW, 0o666)
        except OSError as error:
            raise Refused(f"{subject} cannot be written: {error.strerror}") from error
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno not in (errno.EWOULDBLOCK, errno.EINTR):
                return descriptor
            os.close(descriptor)
            if time.monotonic() >= until:
                raise Refused(f"{subject} is being written by another process") from error
            time.sleep(PAUSE_S)
            continue
        if names(path, descriptor):
            return descriptor
        os.close(descriptor)


def names(path: str, descriptor: int) -> bool:
    """True if the path still names the open file. A process that ended may have deleted it after it was opened."""
    try:
        return os.path.samestat(os.stat(path), os.fstat(descriptor))
    except OSError:
        return False
