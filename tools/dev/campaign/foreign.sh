# ./dev campaign foreign
# shellcheck shell=bash
source "$root/tools/dev/common.sh"

# Meshes refined by DOLFINx are valid; so are those of `tetgen -r`, but their new vertices are no
# midpoints, so that they are not refinements by bisection.
foreign_commands() {
    local shape levels
    use_mpi_on_this_machine
    for shape in "kuhn 3" "fichera" "two-material" "random 500"; do
        # shellcheck disable=SC2086  # the shape's parameters
        run octetra generate $shape -o made.mesh
        # DOLFINx drops markers, so the coarse mesh is also converted by it.
        run "$root/tools/refine_with_dolfinx.py" made.mesh dolfinx.mesh 0
        run octetra convert dolfinx.mesh coarse.mesh --fix-orientation
        for levels in 1 2; do
            run "$root/tools/refine_with_dolfinx.py" coarse.mesh dolfinx.mesh "$levels"
            run octetra convert dolfinx.mesh fine.mesh --fix-orientation
            run octetra verify coarse.mesh fine.mesh
        done
    done
    run octetra generate gear -o gear.1.ele
    run tetgen -Qrqa0.0001 gear.1.ele
    run octetra verify gear.2.ele
    say "${bold}\$ octetra verify gear.1.ele gear.2.ele$plain"
    if octetra verify gear.1.ele gear.2.ele; then die "the verifier accepted an invalid refinement"; fi
    say "Valid meshes were accepted, and the invalid refinement was refused."
}

if (($# > 0)); then bad_usage "foreign takes no arguments"; fi
need build foreign
configure demo release -DOCTETRA_TESTS=OFF -DOCTETRA_BENCH=OFF
build demo
PATH=$root/build/demo/cli:$PATH
hash -r
mkdir -p build/foreign
cd build/foreign
step "foreign meshes" foreign_commands
