#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/output_paths.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/generator/clouds.hpp>
#include <octetra/generator/lattices.hpp>
#include <octetra/generator/solids.hpp>

#include "commands/commands.hpp"
#include "commands/mesh_options.hpp"
#include "commands/number_options.hpp"
#include "parse_numbers.hpp"

namespace octetra::cli {
namespace {

struct GenerateOptions {
    std::string output;
    bool quiet = false;
};

void generate(const GenerateOptions& options, const std::function<Mesh()>& make) {
    check_output(options.output);
    const Mesh mesh = make();
    write_output(mesh, options.output);
    if (!options.quiet) report_written(mesh, options.output);
}

class Shapes {
public:
    Shapes(CLI::App& generate, distributed::Communicator world)
        : generate_(&generate), world_(std::move(world)), common_(declare_common()) {}

    /// Declares a shape. `declare(subcommand)` declares its options and returns the function that
    /// creates the mesh.
    void add(const std::string& name, const std::string& description, const std::string& example,
             const std::function<std::function<Mesh()>(CLI::App&)>& declare) {
        CLI::App* shape = generate_->add_subcommand(name, description);
        shape->fallthrough();  // -o belongs to `generate`, but may follow the shape
        shape->footer(fmt::format("Example:\n  octetra generate {}", example));
        shape->callback([common = common_, world = world_, make = declare(*shape)] {
            world.on_first([&] { generate(*common, make); });
        });
        // False positive: the analyzer does not follow a function stored in another one.
    }  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks)

private:
    std::shared_ptr<GenerateOptions> declare_common() {
        auto common = std::make_shared<GenerateOptions>();
        add_output_option(*generate_, common->output);
        generate_->add_flag("--quiet", common->quiet, "print only notes and errors");
        return common;
    }

    CLI::App* generate_;
    distributed::Communicator world_;
    std::shared_ptr<GenerateOptions> common_;
};

/// The default ranges of numbers for shapes; most shapes check further conditions.
template <class Number>
Range<Number> numbers_for_shapes();
template <>
Range<std::uint64_t> numbers_for_shapes() {
    return whole_numbers_from(0);
}
template <>
Range<double> numbers_for_shapes() {
    return {1e-30, 1e30, "1e-30 to 1e30"};
}

/// Declares an option with a default, which --help shows; returns the storage of its value.
template <class Number>
std::shared_ptr<Number> option(CLI::App& shape, const std::string& name, Number standard,
                               const std::string& description, const std::string& type = "LENGTH") {
    auto value = std::make_shared<Number>(standard);
    add_number(shape, name, *value, numbers_for_shapes<Number>(),
               fmt::format("{} [{}]", description, standard))
        ->type_name(type);
    return value;
}

std::shared_ptr<std::uint64_t> required_count(CLI::App& shape, const std::string& name,
                                              const std::string& description) {
    auto value = std::make_shared<std::uint64_t>(0);
    add_number(shape, name, *value, whole_numbers_from(1), description)->type_name("")->required();
    return value;
}

void add_lattices(Shapes& shapes) {
    shapes.add(
        "kuhn", "a box of bricks, six cells in each", "kuhn 8 -o cube.1.ele",
        [](CLI::App& shape) -> std::function<Mesh()> {
            auto texts = std::make_shared<std::vector<std::string>>();
            auto size = std::make_shared<std::string>("1,1,1");
            shape.add_option("N", *texts, "bricks along every axis, or along x, y and z")
                ->type_name("")
                ->expected(1, 3)
                ->required();
            shape.add_option("--size", *size, "the box's extent [1,1,1]")->type_name("X,Y,Z");
            return [=] {
                if (texts->size() == 2) {
                    throw InputError("kuhn takes one number of bricks or three, not two");
                }
                std::vector<std::uint64_t> counts;
                for (const std::string& text : *texts) {
                    counts.push_back(parse_number("N", text, whole_numbers_from(1)));
                }
                const auto s = parse_reals(*size, 3, "--size", "X,Y,Z");
                return generator::kuhn(counts.front(), counts[counts.size() / 2], counts.back(),
                                       {s[0], s[1], s[2]});
            };
        });
    shapes.add("bcc", "a body-centred cubic lattice (Sommerville's cell)", "bcc 4 -o bcc.1.ele",
               [](CLI::App& shape) -> std::function<Mesh()> {
                   auto n = required_count(shape, "N", "cubes along every axis");
                   auto size = option(shape, "--size", 1.0, "the cube's side");
                   return [=] { return generator::bcc(*n, *size); };
               });
    shapes.add("regular", "one regular cell", "regular -o regular.1.ele",
               [](CLI::App& shape) -> std::function<Mesh()> {
                   auto scale =
                       option(shape, "--scale", 1.0, "half the side of the cube around it");
                   return [=] { return generator::regular(*scale); };
               });
}

void add_clouds(Shapes& shapes) {
    shapes.add("random", "Delaunay mesh of N random points in a cube",
               "random 1000 --seed 7 -o random.1.ele",
               [](CLI::App& shape) -> std::function<Mesh()> {
                   auto n = required_count(shape, "N", "number of points");
                   auto seed = option<std::uint64_t>(shape, "--seed", 0, "random seed", "N");
                   return [=] { return generator::random(*n, *seed); };
               });
    shapes.add("slivers", "badly shaped cells: a minimally perturbed lattice",
               "slivers 6 -o slivers.1.ele", [](CLI::App& shape) -> std::function<Mesh()> {
                   auto n = required_count(shape, "N", "points along every axis");
                   auto seed = option<std::uint64_t>(shape, "--seed", 0, "random seed", "N");
                   return [=] { return generator::slivers(*n, *seed); };
               });
}

void add_solids(Shapes& shapes) {
    const std::string edge_length = "length of the edges of cells";
    shapes.add("sphere", "a ball", "sphere --edge 0.2 -o sphere.1.ele",
               [=](CLI::App& shape) -> std::function<Mesh()> {
                   auto radius = option(shape, "--radius", 1.0, "the ball's radius");
                   auto edge = option(shape, "--edge", 0.3, edge_length);
                   return [=] { return generator::sphere(*radius, *edge); };
               });
    shapes.add("fichera", "a cube without one octant: a re-entrant corner",
               "fichera --edge 0.3 -o fichera.1.ele",
               [=](CLI::App& shape) -> std::function<Mesh()> {
                   auto edge = option(shape, "--edge", 0.5, edge_length);
                   return [=] { return generator::fichera(*edge); };
               });
    shapes.add("torus", "a ring", "torus -o torus.mesh",
               [=](CLI::App& shape) -> std::function<Mesh()> {
                   auto major = option(shape, "--major", 1.0, "radius of the ring");
                   auto minor = option(shape, "--minor", 0.4, "radius of its tube");
                   auto edge = option(shape, "--edge", 0.25, edge_length);
                   return [=] { return generator::torus(*major, *minor, *edge); };
               });
    shapes.add(
        "gear", "a gear with teeth and a bore", "gear --teeth 20 --edge 0.1 -o gear.1.ele",
        [=](CLI::App& shape) -> std::function<Mesh()> {
            const generator::Gear standard;
            auto teeth = option(shape, "--teeth", standard.teeth, "number of teeth", "N");
            auto radius = option(shape, "--radius", standard.outer_radius, "radius at the tips");
            auto thickness = option(shape, "--thickness", standard.thickness, "extent along z");
            auto bore = option(shape, "--bore", standard.bore_radius, "radius of the bore");
            auto edge = option(shape, "--edge", standard.edge_length, edge_length);
            return [=] { return generator::gear({*teeth, *radius, *thickness, *bore, *edge}); };
        });
    shapes.add("two-material", "a cube that contains a ball with another region tag",
               "two-material -o composite.1.ele", [=](CLI::App& shape) -> std::function<Mesh()> {
                   auto radius = option(shape, "--radius", 0.3, "the ball's radius");
                   auto edge = option(shape, "--edge", 0.2, edge_length);
                   return [=] { return generator::two_material(*radius, *edge); };
               });
}

}  // namespace

void add_generate(CLI::App& program, const distributed::Communicator& world) {
    CLI::App* generate =
        program.add_subcommand("generate", "Generate a mesh: lattices, random points, solids");
    generate->require_subcommand(1);
    generate->footer(
        "Each shape has a --help of its own, as in: octetra generate gear --help\n"
        "Example:\n"
        "  octetra generate gear -o gear.1.ele");
    Shapes shapes(*generate, world);
    add_lattices(shapes);
    add_clouds(shapes);
    add_solids(shapes);
}

}  // namespace octetra::cli
