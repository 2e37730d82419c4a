#include "properties/histories/reported_sharers.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace octetra::properties {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using distributed::Sharing;

namespace {

/// A vertex, edge or face by the global numbers of its vertices, ascending, padded with 0.
using Entity = std::array<std::uint64_t, 3>;
using EntitySet = std::set<Entity>;

/// A process's report on an entity that it has.
struct EntityReport {
    Entity entity;
    std::uint64_t number;
    int owner;
    std::vector<int> sharers;
};

/// A process's list of the entities that it shares with another rank, in its order.
struct InterfaceReport {
    int rank;
    std::vector<Entity> entities, owned, received;
};

struct ProcessReport {
    EntitySet has;
    std::vector<EntityReport> said;
    std::vector<InterfaceReport> shared;
};

/// A message of 64-bit words.
class Message {
public:
    Message() = default;
    explicit Message(std::vector<std::uint64_t> words) : words_(std::move(words)) {}

    void add(std::uint64_t word) { words_.push_back(word); }
    void add(const Entity& entity) { words_.insert(words_.end(), entity.begin(), entity.end()); }
    void add(const std::vector<Entity>& entities) {
        add(entities.size());
        for (const Entity& entity : entities) add(entity);
    }
    [[nodiscard]] std::uint64_t next() { return words_.at(at_++); }
    [[nodiscard]] int next_rank() { return static_cast<int>(next()); }
    [[nodiscard]] Entity next_entity() { return {next(), next(), next()}; }
    [[nodiscard]] std::vector<Entity> next_entities() {
        std::vector<Entity> entities(next());
        for (Entity& entity : entities) entity = next_entity();
        return entities;
    }
    [[nodiscard]] const std::vector<std::uint64_t>& words() const { return words_; }

private:
    std::vector<std::uint64_t> words_;
    std::size_t at_ = 0;
};

Entity entity_of(const AdaptiveMesh& mesh, const auto& vertices) {
    Entity entity{};
    std::ranges::transform(vertices, entity.begin(), [&](VertexIndex v) {
        return static_cast<std::uint64_t>(mesh.vertex_numbers()[v.value()]);
    });
    std::ranges::sort(entity.begin(), entity.begin() + std::ssize(vertices));
    return entity;
}

/// The entities of one kind on this process, with its report on them. `entities` and `numbers` are
/// indexed locally.
template <class I>
Message message_of(const std::vector<Entity>& entities, const std::vector<std::uint64_t>& numbers,
                   const Sharing<I>& sharing, const EntitySet& has) {
    Message message;
    message.add(std::vector<Entity>(has.begin(), has.end()));
    message.add(entities.size());
    for (std::size_t i = 0; i < entities.size(); ++i) {
        message.add(entities[i]);
        message.add(numbers[i]);
        message.add(static_cast<std::uint64_t>(sharing.owner(I{i})));
        message.add(sharing.sharers(I{i}).size());
        for (const int rank : sharing.sharers(I{i})) message.add(static_cast<std::uint64_t>(rank));
    }
    message.add(sharing.neighbours().size());
    for (const auto& neighbour : sharing.neighbours()) {
        message.add(static_cast<std::uint64_t>(neighbour.rank));
        for (const auto* list : {&neighbour.entities, &neighbour.owned, &neighbour.received}) {
            std::vector<Entity> listed;
            for (const I i : *list) listed.push_back(entities[i.value()]);
            message.add(listed);
        }
    }
    return message;
}

ProcessReport opened(Message message) {
    ProcessReport process;
    const auto has = message.next_entities();
    process.has = {has.begin(), has.end()};
    for (std::uint64_t left = message.next(); left > 0; --left) {
        EntityReport& said = process.said.emplace_back(
            EntityReport{message.next_entity(), message.next(), message.next_rank(), {}});
        for (std::uint64_t sharers = message.next(); sharers > 0; --sharers) {
            said.sharers.push_back(message.next_rank());
        }
    }
    for (std::uint64_t left = message.next(); left > 0; --left) {
        InterfaceReport shared{message.next_rank(), {}, {}, {}};
        for (auto* list : {&shared.entities, &shared.owned, &shared.received}) {
            *list = message.next_entities();
        }
        process.shared.push_back(std::move(shared));
    }
    return process;
}

/// Checks the reports on single entities.
std::string fault_of_entity_reports(const std::vector<ProcessReport>& processes) {
    std::map<Entity, std::vector<int>> ranks_of;
    for (std::size_t r = 0; r < processes.size(); ++r) {
        for (const Entity& entity : processes[r].has)
            ranks_of[entity].push_back(static_cast<int>(r));
    }
    std::map<Entity, std::pair<std::uint64_t, int>> number_and_owner;
    for (std::size_t r = 0; r < processes.size(); ++r) {
        if (processes[r].said.size() != processes[r].has.size())
            return "an interface of a rank has a wrong length";
        for (const EntityReport& said : processes[r].said) {
            const auto found = ranks_of.find(said.entity);
            if (found == ranks_of.end()) return "a rank has an entity of no cell";
            std::vector<int> others = found->second;
            if (std::erase(others, static_cast<int>(r)) != 1)
                return "a rank has an entity of none of its cells";
            if (said.sharers != others) return "a rank reports wrong sharers";
            if (std::ranges::find(found->second, said.owner) == found->second.end()) {
                return "the owner of an entity does not have it";
            }
            const std::pair told(said.number, said.owner);
            if (number_and_owner.emplace(said.entity, told).first->second != told) {
                return "two ranks report different numbers or owners of an entity";
            }
        }
    }
    std::uint64_t next = 0;  // ascending by vertex numbers, which are those of the whole mesh
    for (const auto& [entity, told] : number_and_owner) {
        const bool is_vertex = entity[1] == 0 && entity[2] == 0;
        if (!is_vertex && told.first != next++) return "numbers do not follow those of vertices";
    }
    return {};
}

/// Checks the lists of pairs of ranks.
std::string fault_of_interface_reports(const std::vector<ProcessReport>& processes) {
    for (std::size_t r = 0; r < processes.size(); ++r) {
        std::size_t shared_with_any = 0;
        for (const InterfaceReport& here : processes[r].shared) {
            const auto& other = processes.at(static_cast<std::size_t>(here.rank));
            const auto there =
                std::ranges::find(other.shared, static_cast<int>(r), &InterfaceReport::rank);
            if (there == other.shared.end()) return "an interface exists on one rank only";
            if (there->entities != here.entities || there->received != here.owned) {
                return "two ranks list an interface in different orders";
            }
            EntitySet common;
            std::ranges::set_intersection(processes[r].has, other.has,
                                          std::inserter(common, common.end()));
            if (EntitySet(here.entities.begin(), here.entities.end()) != common ||
                here.entities.size() != common.size()) {
                return "an interface does not contain all common entities";
            }
            shared_with_any += common.size();
        }
        std::size_t expected = 0;
        for (const EntityReport& said : processes[r].said) expected += said.sharers.size();
        if (shared_with_any != expected) return "a rank has no interface with a sharer";
    }
    return {};
}

/// Collective. Returns the fault on the first process.
std::string fault_on_first(const Communicator& group, const Message& message) {
    std::vector<ProcessReport> processes;
    for (const auto& words : group.gather(message.words())) {
        processes.push_back(opened(Message(words)));
    }
    const std::string fault = fault_of_entity_reports(processes);
    return fault.empty() ? fault_of_interface_reports(processes) : fault;
}

std::string fault_of_vertices(const AdaptiveMesh& mesh) {
    std::vector<Entity> entities;
    std::vector<std::uint64_t> numbers;
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
        entities.push_back(entity_of(mesh, std::array{VertexIndex{v}}));
        numbers.push_back(entities.back()[0]);
    }
    // Vertices of no cell are on some rank as well.
    const EntitySet has(entities.begin(), entities.end());
    return fault_on_first(mesh.processes(),
                          message_of(entities, numbers, mesh.vertex_sharing(), has));
}

template <std::size_t N, std::size_t PerCell>
std::string fault_of_sides(const AdaptiveMesh& mesh, const auto& sides,
                           const std::array<std::array<std::uint8_t, N>, PerCell>& places) {
    EntitySet has;
    for (const CellVertices& cell : mesh.cells()) {
        for (const auto& side : places) {
            std::array<VertexIndex, N> vertices;
            std::ranges::transform(side, vertices.begin(), [&](auto place) { return cell[place]; });
            has.insert(entity_of(mesh, vertices));
        }
    }
    std::vector<Entity> entities;
    for (const auto& vertices : sides.vertices) entities.push_back(entity_of(mesh, vertices));
    return fault_on_first(
        mesh.processes(),
        message_of(entities, {sides.numbers.begin(), sides.numbers.end()}, sides.sharing, has));
}

}  // namespace

std::string fault_of_reported_sharers(const AdaptiveMesh& mesh) {
    const std::string of_vertices = fault_of_vertices(mesh);
    const std::string of_edges = fault_of_sides(mesh, mesh.number_edges(), cell_edges);
    const std::string of_faces = fault_of_sides(mesh, mesh.number_faces(), cell_faces);
    if (!of_vertices.empty()) return "vertices: " + of_vertices;
    if (!of_edges.empty()) return "edges: " + of_edges;
    return of_faces.empty() ? "" : "faces: " + of_faces;
}

}  // namespace octetra::properties
