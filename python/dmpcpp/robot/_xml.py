"""A description's XML, read as leniently as urdfdom does: leftovers of xacro have prefixes that nobody declares."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

__all__ = ["parsed"]

_PREFIXED = re.compile(r"(?:</?|\s)([A-Za-z_][\w.-]*):[A-Za-z_][\w.-]*(?=[\s=/>])")


def parsed(urdf: str) -> ET.Element:
    """Return the <robot> of a text that an arm was read from, or that was described for an engine.

    Prefixes that the text does not declare, such as xacro's in what it left behind, are declared.

    Raises
    ------
    xml.etree.ElementTree.ParseError
        It is not XML for another reason.
    """
    try:
        return ET.fromstring(urdf)
    except ET.ParseError:
        known = set(re.findall(r"xmlns:([\w.-]+)\s*=", urdf)) | {"xml", "xmlns"}
        missing = sorted(set(_PREFIXED.findall(urdf)) - known)
        declared = "".join(f' xmlns:{prefix}="{prefix}"' for prefix in missing)
        return ET.fromstring(re.sub(r"<robot\b", f"<robot{declared}", urdf, count=1))
