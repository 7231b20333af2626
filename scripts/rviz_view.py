#!/usr/bin/python3
"""Opens rviz with a view of this package, its frames under a prefix: usage: rviz_view.py VIEW.rviz [PREFIX]."""

import os
import re
import sys
import tempfile


def with_prefix(text, prefix):
    """The view with PREFIX/ before each name of a frame."""
    text = re.sub(r"((?:Fixed|Target|Reference) Frame: )(\w)", rf"\1{prefix}/\2", text)
    text = text.replace('TF Prefix: ""', f"TF Prefix: {prefix}")
    return re.sub(r"^(        )(\w+):$(?=\n          Value:)", rf"\1{prefix}/\2:", text, flags=re.M)


def main():
    arguments = [argument for argument in sys.argv[1:] if ":=" not in argument]
    ros_arguments = [argument for argument in sys.argv[1:] if ":=" in argument]
    if not 1 <= len(arguments) <= 2:
        sys.exit(__doc__)
    view, prefix = arguments[0], (arguments + [""])[1].strip("/")
    if prefix:
        with open(view, encoding="utf-8") as file:
            text = with_prefix(file.read(), prefix)
        # rviz reads it after this process has become rviz
        with tempfile.NamedTemporaryFile("w", suffix=".rviz", prefix="slipnav_", delete=False, encoding="utf-8") as file:
            file.write(text)
            view = file.name
    os.execvp("rviz", ["rviz", "-d", view] + ros_arguments)


if __name__ == "__main__":
    main()
