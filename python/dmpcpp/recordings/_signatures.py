"""Files that no reader takes, known by their first bytes: what they are and what to do instead."""

from __future__ import annotations

from pathlib import Path

__all__ = ["known_other"]

_ADVICE = "Export the poses as a table (CSV) or a NumPy array, with times."
_PICKLE = (b"\x80\x02", b"\x80\x03", b"\x80\x04", b"\x80\x05", b"(lp0", b"(dp0")
_PICKLE_SUFFIXES = (".pkl", ".pickle", ".p", ".pt", ".pth", ".joblib")
_STARTS = (
    (b"\x1f\x8b", "a gzip archive. Unpack it first."),
    (b"7z\xbc\xaf", "a 7z archive. Unpack it first."),
    (b"MATLAB 5.0", f"a MATLAB file. {_ADVICE}"),
    (b"Kaydara FBX", "an FBX file. Export it as BVH, or the poses as a table."),
    (b"glTF", f"a glTF file. {_ADVICE}"),
    (b"PXR-USDC", f"a USD file. {_ADVICE}"),
    (b"%PDF", "a PDF."),
    (b"\x89PNG", "a picture."),
    (b"\xff\xd8\xff", "a picture."),
    (b"VRS0", f"a VRS recording of sensors. {_ADVICE}"),
)


def known_other(path: Path, head: bytes) -> str:
    """Return what a file is and what to do with it, "" where its first bytes do not tell."""
    if head.startswith(_PICKLE) or path.suffix.lower() in _PICKLE_SUFFIXES:
        return f"a pickle, which can run any code and is never opened. {_ADVICE}"
    for start, said in _STARTS:
        if head.startswith(start):
            return said
    if head[4:8] == b"ftyp" or head.startswith(b"\x1aE\xdf\xa3"):
        return "a video. Recordings are poses over time, not pictures."
    if head.startswith(b"PK\x03\x04"):
        return "a zip archive. Unpack it first."
    if head.lstrip()[:1] in (b"{", b"["):
        return (
            f"JSON of no layout that is known (DeepMimic clips with Frames of 44 numbers, HOT3D hand poses). {_ADVICE}"
        )
    if head.lstrip().startswith(b"<?xml"):
        return f"XML of no format that is known. {_ADVICE}"
    return ""
