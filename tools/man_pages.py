#!/usr/bin/env python3
"""Makes octetra.1 and a manual page for each subcommand from the output of --help, with help2man.

tools/man_pages.py --octetra PROGRAM -o FOLDER
"""

import argparse
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile


def printed(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: status {done.returncode}\n{done.stderr}")
    return done.stdout


def cut(text, beginning):
    """Splits the text at the line with this beginning."""
    found = re.search(rf"^{re.escape(beginning)}", text, re.MULTILINE)
    return (text[:found.start()], text[found.start():]) if found else (text, "")


def names_below(text):
    """The subcommands that a help text lists."""
    _, listed = cut(text, "Subcommands:")
    return re.findall(r"^  (\S+)", listed.split("\n\n")[0], re.MULTILINE)


def verbatim(text):
    """Lines that troff neither joins nor interprets as requests."""
    escaped = text.strip("\n").replace("\\", "\\e").replace("-", "\\-")
    return ".nf\n" + "\n".join(f"\\&{line}" for line in escaped.splitlines()) + "\n.fi\n"


def see_also(name, names):
    return ", ".join(f"\\fB{other}\\fR(1)" for other in names if other != name) + "\n"


def sections_of(name, text, names, shapes):
    """Returns the help text without its end, and the sections made from its end."""
    summary = text.splitlines()[0].rstrip(".")
    rest, example = cut(text, "Example:")
    rest, status = cut(rest, "Exit status:")
    # Sentences such as "Each shape has a --help of its own" remain; a blank is added between
    # options.
    rest = re.sub(r"^( +-\w),(--)", r"\1, \2", rest, flags=re.MULTILINE)
    included = f"[NAME]\n{name} \\- {summary[0].lower() + summary[1:]}\n"
    if shapes:
        included += "[SHAPES]\n" + verbatim("\n".join(shapes))
    if status:
        statuses = status.removeprefix("Exit status:").strip().replace("\n", " ").split("; ")
        included += "[EXIT STATUS]\n" + "\n.br\n".join(words.rstrip(".") for words in statuses) + "\n"
    if example:
        included += "[EXAMPLES]\n" + verbatim(example.partition("\n")[2])
    return rest, included + "[SEE ALSO]\n" + see_also(name, names)


def write_page(help2man, name, version, rest, included, output):
    with tempfile.TemporaryDirectory(prefix="man-") as folder:
        folder = pathlib.Path(folder)
        (folder / "help").write_text(rest)
        (folder / "included").write_text(included)
        # help2man runs a program of this name with --help and --version.
        program = folder / name
        program.write_text(f"#!/bin/sh\nif [ \"$1\" = --version ]; then echo {shlex.quote(version)};\n"
                           f"else cat {shlex.quote(str(folder / 'help'))}; fi\n")
        program.chmod(0o755)
        environment = {**os.environ, "LC_ALL": "C.UTF-8"}
        subprocess.run([help2man, "--no-info", f"--include={folder / 'included'}",
                        f"--version-string={version}", f"--output={output / (name + '.1')}",
                        str(program)], check=True, env=environment)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--octetra", required=True, metavar="PROGRAM")
    parser.add_argument("--help2man", default="help2man", metavar="PROGRAM")
    parser.add_argument("-o", "--output", required=True, type=pathlib.Path, metavar="FOLDER")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)

    top = printed([options.octetra, "--help"])
    version = printed([options.octetra, "--version"]).split()[-1]
    subcommands = names_below(top)
    names = ["octetra", *(f"octetra-{word}" for word in subcommands)]
    for name, words in zip(names, [[], *([word] for word in subcommands)]):
        text = printed([options.octetra, *words, "--help"])
        shapes = [printed([options.octetra, *words, shape, "--help"])
                  for shape in names_below(text)] if words else []
        rest, included = sections_of(name, text, names, shapes)
        write_page(options.help2man, name, version, rest, included, options.output)


if __name__ == "__main__":
    main()
