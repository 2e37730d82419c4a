#include <algorithm>
#include <array>
#include <new>
#include <span>
#include <string>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "parts/exchange.hpp"
#include "parts/packing.hpp"

/// The first process reads the file and sends entities to their owners in collective rounds: no
/// process ever holds more than its slice and the bytes of a round.
namespace octetra::verify {
namespace {

/// The type of the next item in the bytes of a round.
enum class Item : std::uint8_t {
    points,
    cells,
    facets,
    edges,
    end_of_round,
    end,
    input_error,
    failure
};

/// Data known at the end of the file.
struct Ending {
    Totals totals;
    std::uint64_t attributes_per_point;
    std::uint32_t index_base;
    bool has_point_markers, has_regions, has_facet_markers, has_edge_markers;
};

/// Assembles the slice from the received rounds.
class Receiver {
public:
    /// Takes the bytes of a round. Returns false after the last one. Throws errors of the first
    /// process.
    bool take(const ProcessGroup::Bytes& bytes) {
        Unpacker unpack(bytes);
        while (true) {
            Item item{};
            unpack(item);
            switch (item) {
                case Item::points:
                    append(unpack, lists_.points);
                    append(unpack, lists_.point_attributes);
                    append(unpack, lists_.point_markers);
                    break;
                case Item::cells: append(unpack, lists_.cells, lists_.regions); break;
                case Item::facets: append(unpack, lists_.facets, lists_.facet_markers); break;
                case Item::edges: append(unpack, lists_.edges, lists_.edge_markers); break;
                case Item::end_of_round: return true;
                case Item::end: unpack(ending_); return false;
                case Item::input_error: throw InputError(text_of(unpack));
                case Item::failure: throw SystemError(text_of(unpack));
            }
        }
    }

    [[nodiscard]] MeshSlice slice() {
        lists_.attributes_per_point = ending_.attributes_per_point;
        lists_.index_base = ending_.index_base;
        if (!ending_.has_point_markers) lists_.point_markers = {};
        if (!ending_.has_regions) lists_.regions = {};
        if (!ending_.has_facet_markers) lists_.facet_markers = {};
        if (!ending_.has_edge_markers) lists_.edge_markers = {};
        return {std::move(lists_), ending_.totals};
    }

private:
    template <class List>
    static void append(Unpacker& unpack, List& list) {
        std::vector<typename List::value_type> values;
        unpack.list(values);
        list.insert(list.end(), values.begin(), values.end());
    }
    template <class Entities, class Markers>
    static void append(Unpacker& unpack, Entities& entities, Markers& markers) {
        append(unpack, entities);
        append(unpack, markers);
    }
    static std::string text_of(Unpacker& unpack) {
        std::string text;
        unpack.list(text);
        return text;
    }

    Mesh lists_;
    Ending ending_{};
};

/// Distributes the entities that the first process reads. The last round is still to be sent after
/// the file has been read.
class Distributor final : public MeshSink {
public:
    Distributor(const ProcessGroup& group, Receiver& own)
        : group_(group), own_(own), to_each_(static_cast<std::size_t>(group.size())) {}

    void expect_points(std::uint64_t count, std::size_t attributes, bool) override {
        points_.count = ending_.totals.vertices = count;
        ending_.attributes_per_point = attributes;
    }
    void expect_cells(std::uint64_t count, bool) override {
        cells_.count = ending_.totals.cells = count;
    }
    void expect_facets(std::uint64_t count, bool) override {
        facets_.count = ending_.totals.facets = count;
    }
    void expect_edges(std::uint64_t count, bool) override {
        edges_.count = ending_.totals.edges = count;
    }

    void take_points(std::span<const Point> points, std::span<const double> attributes,
                     std::span<const Marker> markers) override {
        share(points_, points.size(), [&](Packer& pack, std::size_t begin, std::size_t count) {
            const std::size_t per_point = ending_.attributes_per_point;
            pack(Item::points);
            pack.list(points.subspan(begin, count));
            pack.list(attributes.subspan(begin * per_point, count * per_point));
            pack.list(markers.empty() ? markers : markers.subspan(begin, count));
        });
    }
    void take_cells(std::span<const CellVertices> cells, std::span<const Marker> regions) override {
        share_entities(Item::cells, cells_, cells, regions);
    }
    void take_facets(std::span<const FacetVertices> facets,
                     std::span<const Marker> markers) override {
        share_entities(Item::facets, facets_, facets, markers);
    }
    void take_edges(std::span<const EdgeVertices> edges, std::span<const Marker> markers) override {
        share_entities(Item::edges, edges_, edges, markers);
    }

    void finish(const MeshFacts& facts) override {
        ending_.index_base = facts.index_base;
        ending_.has_point_markers = facts.has_point_markers;
        ending_.has_regions = facts.has_regions;
        ending_.has_facet_markers = facts.has_facet_markers;
        ending_.has_edge_markers = facts.has_edge_markers;
    }

    void send_end() {
        send([&](Packer& pack) {
            pack(Item::end);
            pack(ending_);
        });
    }
    void send_error(Item item, const std::string& what) {
        for (Packer& pack : to_each_) pack.bytes().clear();  // an item may be incomplete
        forward_round(packed([&](Packer& pack) {
            pack(item);
            pack.list(what);
        }));
    }

    /// Returns whether an error occurred in the exchange, so that all processes know of it.
    [[nodiscard]] bool is_exchanging() const { return is_exchanging_; }

private:
    static constexpr std::size_t bytes_of_a_round = std::size_t{4} << 20U;

    struct Progress {
        std::uint64_t count = 0;
        std::uint64_t received = 0;
    };

    /// Calls pack_some(packer, begin, count) for each process that owns some of the next n
    /// entities.
    void share(Progress& progress, std::size_t n, auto&& pack_some) {
        const Window slices = slices_of(progress.count, group_.size());
        const std::uint64_t end = progress.received + n;
        for (std::uint64_t at = progress.received; at < end;) {
            const auto rank = static_cast<int>(at / slices.slice_length);
            const std::uint64_t stop = std::min(end, slices.end_of(rank));
            pack_some(to_each_[static_cast<std::size_t>(rank)], at - progress.received, stop - at);
            at = stop;
        }
        progress.received = end;
        std::size_t bytes = 0;
        for (Packer& pack : to_each_) bytes += pack.bytes().size();
        if (bytes >= bytes_of_a_round) {
            send([](Packer& pack) { pack(Item::end_of_round); });
        }
    }

    template <class Entities>
    void share_entities(Item item, Progress& progress, Entities entities,
                        std::span<const Marker> markers) {
        share(progress, entities.size(), [&](Packer& pack, std::size_t begin, std::size_t count) {
            pack(item);
            pack.list(entities.subspan(begin, count));
            pack.list(markers.empty() ? markers : markers.subspan(begin, count));
        });
    }

    /// Processes this process's own bytes first: an error later could not be sent any more.
    void send(auto&& pack_last) {
        std::vector<ProcessGroup::Bytes> outboxes = packed(pack_last);
        (void)own_.take(std::exchange(outboxes.front(), {}));
        forward_round(std::move(outboxes));
    }
    [[nodiscard]] std::vector<ProcessGroup::Bytes> packed(auto&& pack_last) {
        std::vector<ProcessGroup::Bytes> outboxes;
        outboxes.reserve(to_each_.size());
        for (Packer& pack : to_each_) {
            pack_last(pack);
            outboxes.push_back(std::exchange(pack.bytes(), {}));
        }
        return outboxes;
    }
    void forward_round(std::vector<ProcessGroup::Bytes> outboxes) {
        is_exchanging_ = true;
        (void)group_.exchange(std::move(outboxes));
        is_exchanging_ = false;
    }

    const ProcessGroup& group_;
    Receiver& own_;
    std::vector<Packer> to_each_;
    bool is_exchanging_ = false;
    Ending ending_{};
    Progress points_, cells_, facets_, edges_;
};

/// Runs the first process's side. Errors are thrown on all processes.
void read_and_distribute(const std::filesystem::path& path, const ReadOptions& options,
                         const ProcessGroup& group, Receiver& own) {
    Distributor distributor(group, own);
    std::string what;
    Item ended = Item::end;
    try {
        stream_mesh(path, distributor, options);
        distributor.send_end();
        return;
    } catch (const InputError& error) {
        ended = Item::input_error;
        what = error.what();
    } catch (const std::bad_alloc&) {
        if (distributor.is_exchanging()) throw;
        ended = Item::failure;
        what = "out of memory";
    } catch (const std::exception& error) {
        if (distributor.is_exchanging()) throw;
        ended = Item::failure;
        what = error.what();
    }
    distributor.send_error(ended, what);
    if (ended == Item::input_error) throw InputError(what);
    throw SystemError(what);
}

}  // namespace

MeshSlice read_slice(const std::filesystem::path& path, const ReadOptions& options,
                     const ProcessGroup& group) {
    const StandardArithmetic standard;
    Receiver receiver;
    if (group.is_first()) {
        read_and_distribute(path, options, group, receiver);
    } else {
        const auto nothing = [&] {
            return std::vector<ProcessGroup::Bytes>(static_cast<std::size_t>(group.size()));
        };
        while (receiver.take(group.exchange(nothing()).front())) {
        }
    }
    return receiver.slice();
}

}  // namespace octetra::verify
