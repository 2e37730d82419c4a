#include "assemble/root_message.hpp"

#include "comm/packed.hpp"

namespace octetra::distributed {

std::vector<std::byte> RootMessage::packed() const {
    if (vertices.empty()) return {};
    Packer packer;
    packer.put(roots);
    packer.put(cuts);
    packer.put(vertices);
    packer.put(points);
    packer.put(point_markers);
    packer.put(point_attributes);
    packer.put(facets);
    packer.put(edges);
    return std::move(packer).take();
}

RootMessage RootMessage::unpacked(std::span<const std::byte> bytes) {
    if (bytes.empty()) return {};
    Unpacker unpacker(bytes);
    RootMessage message;
    message.roots = unpacker.take<Root>();
    message.cuts = unpacker.take<std::uint8_t>();
    message.vertices = unpacker.take<GlobalVertex>();
    message.points = unpacker.take<Point>();
    message.point_markers = unpacker.take<Marker>();
    message.point_attributes = unpacker.take<double>();
    message.facets = unpacker.take<Tagged<3>>();
    message.edges = unpacker.take<Tagged<2>>();
    return message;
}

}  // namespace octetra::distributed
