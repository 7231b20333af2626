"""slipnav's own programs, for what they can read."""

import os
import subprocess

from slipnav_import.failure import Failure


def run(folder, name, *arguments):
    """What a program prints and what it says on standard error, by lines; Failure with that if it fails."""
    try:
        process = subprocess.run([os.path.join(folder, name), *arguments], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True, check=False)
    except OSError as error:
        raise Failure(f"the program '{name}' is not there: ./run build makes it") from error
    said = process.stderr.strip()
    if process.returncode != 0:
        raise Failure(said[len(name) + 2:] if said.startswith(f"{name}: ") else said or f"{name} failed")
    return process.stdout.splitlines(), said.splitlines()
