"""The arm as the programs around it see it: known arms, defects of a URDF, its reach and its description."""
