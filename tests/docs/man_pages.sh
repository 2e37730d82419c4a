#!/bin/sh
# man_pages.sh PROGRAM FOLDER: checks that the manual pages are made, one for each subcommand, and
# that troff gives no warnings. Exits with 77 if the tools are not installed.
set -eu
for tool in help2man groff; do
    if ! command -v "$tool" >/dev/null; then
        echo "skipped: $tool is not installed"
        exit 77
    fi
done
rm -rf "$2"
"$(dirname "$0")/../../tools/man_pages.py" --octetra "$1" -o "$2"
for name in octetra octetra-refine octetra-verify octetra-certify octetra-compare octetra-info octetra-generate \
    octetra-convert octetra-partition octetra-adapt \
    octetra-coarsen; do
    warnings=$(groff -ww -man -Tutf8 "$2/$name.1" 2>&1 >/dev/null)
    if [ -n "$warnings" ]; then
        echo "$name.1: $warnings"
        exit 1
    fi
done
