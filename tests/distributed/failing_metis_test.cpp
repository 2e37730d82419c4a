#include <dlfcn.h>
#include <metis.h>

#include <csignal>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

namespace {

bool metis_fails = false;
volatile std::sig_atomic_t signals_received = 0;

extern "C" void count_signal(int /*signal*/) { signals_received = signals_received + 1; }

}  // namespace

/// Wraps the METIS function of this name, or fails as METIS does at a SIGTERM.
extern "C" int METIS_PartGraphKway(idx_t* nodes, idx_t* constraints, idx_t* begin,
                                   idx_t* neighbours, idx_t* node_weights, idx_t* sizes,
                                   idx_t* weights, idx_t* parts, real_t* shares, real_t* imbalance,
                                   idx_t* options, idx_t* cut, idx_t* part_of_node) {
    if (metis_fails) return METIS_ERROR;
    static const auto original =
        reinterpret_cast<decltype(&METIS_PartGraphKway)>(::dlsym(RTLD_NEXT, "METIS_PartGraphKway"));
    return original(nodes, constraints, begin, neighbours, node_weights, sizes, weights, parts,
                    shares, imbalance, options, cut, part_of_node);
}

namespace octetra::distributed {
namespace {

TEST(FailureOfMetis, IsThrownOnAllProcessesAndRaisesNoSignal) {
    const Communicator& world = test::world();
    if (world.size() == 1) GTEST_SKIP() << "one process is not partitioned";
    const test::SharedFolder folder;
    world.on_first([&] { (void)write_mesh(test::perturbed_kuhn(4, 0.2, 1), folder / "m.mesh"); });
    auto* const before = std::signal(SIGTERM, count_signal);
    for (const std::string method : {"lepp", "dual"}) {
        const auto read = [&] {
            (void)AdaptiveMesh::read(world, folder / "m.mesh", parse_partition(method));
        };
        metis_fails = true;
        EXPECT_EQ(test::thrown_by<SystemError>(read),
                  "METIS could not partition the mesh: it reported an error, or received SIGTERM");
        metis_fails = false;
        read();
    }
    EXPECT_EQ(signals_received, 0);
    (void)std::signal(SIGTERM, before);
}

}  // namespace
}  // namespace octetra::distributed
