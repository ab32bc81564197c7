"""Names of what is measured."""
import hashlib


def hash_of(*parts: str) -> str:
    """16 hexadecimal digits, of all parts and of where each ends."""
    return hashlib.sha256(b"".join(part.encode(errors="surrogateescape") + b"\0" for part in parts)).hexdigest()[:16]
