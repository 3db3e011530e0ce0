// The results that ribvault_steps writes.
#pragma once

#include "result_json.hpp"

namespace ribvault::steps {

/// ribvault-layers/1: slices, cavities, supports and paths of the layers `from` to `to` (-1: the top), bottom layer
/// first.
Json layers(const Options& options, int from, int to);

/// ribvault-stages/1: how S_i comes from S_{i+1}, stage by stage (Sections 4.1 to 4.3), i = `layer`, or with -1 the
/// layer on which Copy both clips and prolongs most. The stages are called one by one and must end where the pipeline's
/// run did; when they do not, throws std::logic_error.
Json stages(const Options& options, int layer);

/// ribvault-tree/1: one tree of S_i, the one whose number of branches is nearest to `branches`: its way through the
/// straightening operator until nothing moves any more, that of its longest chain alone, and the order in which it is
/// printed.
Json tree(const Options& options, int layer, int branches);

}  // namespace ribvault::steps
