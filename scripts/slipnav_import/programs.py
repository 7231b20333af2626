"""slipnav's own programs, for the formats they read."""

import os
import subprocess

from slipnav_import.failure import Failure


def run(folder, name, *arguments):
    """The lines of a program on standard output and standard error; Failure with the latter if it fails."""
    try:
        process = subprocess.run([os.path.join(folder, name), *arguments], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True, check=False)
    except OSError as error:
        raise Failure(f"the program '{name}' is missing: ./run build makes it") from error
    said = process.stderr.strip()
    if process.returncode != 0:
        raise Failure(said[len(name) + 2:] if said.startswith(f"{name}: ") else said or f"{name} failed")
    return process.stdout.splitlines(), said.splitlines()
