"""The one digest: of recipes' words, numbers and other digests."""

import hashlib

import msgspec


def hashed(facts) -> str:
    """32 hexadecimal digits for anything that JSON can say."""
    return hashlib.blake2b(msgspec.json.encode(facts, order="deterministic"), digest_size=16).hexdigest()
