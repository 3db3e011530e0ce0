// The supports of all layers as a sweep made them, on disk, so that the run after it need not make them again.
#pragma once

#include <string>
#include <vector>

#include "ribvault/pipeline/layer_spool.hpp"
#include "ribvault/vault/next_layer.hpp"

namespace ribvault {

/// As bytes; unpacked_supports gives back a graph with the same vertices and edges in the same order.
std::string packed_supports(const LayerSupports& supports);
LayerSupports unpacked_supports(const std::string& bytes);

/// Of several sweeps that go down together, from the top layer.
class KeptSupports {
public:
    /// Throws Error (cannot_write) when there is no place for a temporary file.
    explicit KeptSupports(std::size_t sweeps) : sweeps_(sweeps) {}

    /// S_i of every sweep, packed_supports, in the same order each time, once S_{i-1} is known: until then the branches
    /// that end on layer i are not marked.
    void add(const std::vector<std::string>& supports) {
        for (const std::string& bytes : supports) spool_.add(bytes);
    }
    /// After the last layer. Throws Error (cannot_write) when the disk is full.
    void finish() { spool_.finish(); }
    /// `depth`: so many layers were added before it. May be called from several threads at once.
    LayerSupports at(std::size_t sweep, std::size_t depth) const {
        return unpacked_supports(spool_.at(depth * sweeps_ + sweep));
    }

private:
    std::size_t sweeps_;
    LayerSpool spool_;
};

}  // namespace ribvault
