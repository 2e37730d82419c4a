#!/bin/sh
# fast_math.sh MPIRUN PLAIN FAST: checks that a program linked with -ffast-math, whose start-up code
# sets the processor to flush subnormal numbers to zero, writes the same bytes as the program
# without the option.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/in.mesh" <<'END'
MeshVersionFormatted 2
Dimension 3
Vertices
4
1e-310 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
Tetrahedra
1
1 2 3 4 0
End
END
"$1" 1 "$2" "$folder/in.mesh" "$folder/plain.mesh"
"$1" 1 "$3" "$folder/in.mesh" "$folder/fast.mesh"
grep -q '^1e-310 ' "$folder/plain.mesh"
cmp "$folder/plain.mesh" "$folder/fast.mesh"
