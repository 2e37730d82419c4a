#include <map>

#include "refinement/descent.hpp"

namespace octetra::verify {
namespace {

/// A vertex as a weighted mean of vertices of the coarse mesh.
using Weights = std::map<VertexIndex, double>;

/// Weights are sums of powers of 2^-depth, which are exact in binary64 up to a depth of fifty.
void add_weights(VertexIndex v, double weight, const Descent& descent, Weights& weights) {
    const EdgeVertices& ends = descent.halves[v];
    if (ends[0].is_none()) {
        weights[v] += weight;
        return;
    }
    for (const VertexIndex end : ends) add_weights(end, weight / 2, descent, weights);
}

}  // namespace

bool is_half_way(VertexIndex m, const EdgeVertices& edge, const Descent& descent) {
    const EdgeVertices& known = descent.halves[m];
    if (known == edge || known == EdgeVertices{edge[1], edge[0]}) return true;
    Weights of_midpoint;
    Weights of_edge;
    add_weights(m, 1, descent, of_midpoint);
    for (const VertexIndex end : edge) add_weights(end, 0.5, descent, of_edge);
    return of_midpoint == of_edge;
}

}  // namespace octetra::verify
