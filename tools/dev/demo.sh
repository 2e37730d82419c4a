# ./dev demo
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

# The commands of the demo.
demo_commands() {
    run octetra generate gear -o demo/gear.1.ele
    run octetra convert demo/gear.1.ele demo/gear.vtu
    run octetra refine demo/gear.1.ele --sphere 1,0,0.15,0.4 --levels 2 -o demo/fine.vtu
    run octetra refine demo/gear.1.ele --sphere 1,0,0.15,0.4 --levels 2 -o demo/fine.1.ele
    run octetra info demo/fine.1.ele
    run octetra verify demo/gear.1.ele demo/fine.1.ele --sphere 1,0,0.15,0.4 --levels 2
    demo_of_ranks
    draw_demo
    say
    say "before: $(in_short demo/gear.1.ele)"
    say "after:  $(in_short demo/fine.1.ele)"
    say "The files written on 1, 2, 3 and 4 ranks and by the reference are identical."
    say "For ParaView: $root/demo/gear.vtu and $root/demo/fine.vtu"
    if [[ -e demo/picture.png ]]; then say "The picture:  $root/demo/picture.png"; fi
    say "A report on more meshes, ranks and partitions: ./dev equivalence --quick"
}

# in_short MESH: summarises the output of `octetra info` in one line.
in_short() {
    octetra info "$1" | awk '
        /^  vertices / { vertices = $2 }
        /^  cells +[0-9]/ { cells = $2 }
        /^  total volume / { volume = $3 }
        /^  dihedral angle, / { low = $4; high = $5 }
        /^  eta / { eta = $6 }
        END { printf "%s vertices, %s cells, volume %s, dihedral angles %s to %s degrees, mean eta %s\n",
                     vertices, cells, volume, low, high, eta }'
}

# The same refinement on 1 to 4 ranks and by the serial reference, compared byte by byte.
demo_of_ranks() {
    local ranks extension
    use_mpi_on_this_machine
    run octetra refine demo/gear.1.ele --sphere 1,0,0.15,0.4 --levels 2 --engine reference \
        -o demo/reference.1.ele
    for ranks in 1 2 3 4; do
        run mpirun -n "$ranks" octetra refine demo/gear.1.ele --sphere 1,0,0.15,0.4 --levels 2 \
            -o "demo/ranks-$ranks.1.ele"
    done
    for extension in node ele face edge; do
        for ranks in 1 2 3 4; do
            run cmp "demo/ranks-$ranks.1.$extension" "demo/reference.1.$extension"
        done
        run cmp "demo/fine.1.$extension" "demo/reference.1.$extension"
    done
    say "identical"
}

# A picture requires VTK and an X server. The demo works without it.
draw_demo() {
    local picture=(tools/render.py demo/gear.vtu demo/fine.vtu -o demo/picture.png --view "1,-0.25,1.2")
    rm -f demo/picture.png
    if /usr/bin/python3 -c 'import vtkmodules.vtkRenderingOpenGL2' 2>/dev/null &&
        { [[ -n ${DISPLAY:-} ]] || command -v Xvfb >/dev/null; }; then
        say "${bold}\$ ${picture[*]}$plain"
        if "${picture[@]}"; then return; fi
        say "The picture could not be drawn, for the reason above; the meshes are complete."
    else
        say
        say "For a picture of both meshes, install $(packages_of picture | xargs | sed 's/ / and /'),"
        say "then run ./dev demo again."
    fi
}

if (($# > 0)); then bad_usage "demo takes no arguments"; fi
need build
# Large units compile faster in all: nobody edits this build.
configure demo release -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 -DOCTETRA_TESTS=OFF -DOCTETRA_BENCH=OFF -DOCTETRA_PYTHON_MODULE=OFF \
    -DOCTETRA_DOLFINX=OFF -DOCTETRA_PETSC=OFF -DOCTETRA_WARNINGS_AS_ERRORS=OFF
build demo octetra
check_writable demo
mkdir -p demo
PATH=$root/build/demo/cli:$PATH
hash -r
step "demo" demo_commands
