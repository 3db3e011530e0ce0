// Welds vertices and collects triangles for the readers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "ribvault/mesh/mesh.hpp"

namespace ribvault {

class MeshBuilder {
public:
    /// Room for so many triangles; the caller has checked that the file is long enough to hold them.
    void reserve(std::size_t triangles);
    /// Index of the vertex with exactly these (finite) coordinates, new or met before.
    int vertex(double x, double y, double z);
    /// Adds a triangle over indices that vertex() returned, or counts it as degenerate.
    void triangle(int a, int b, int c);
    /// Adds the fan of a polygon from its first corner; fewer than three corners count as one degenerate triangle.
    void polygon(std::span<const int> corners);
    std::size_t triangles() const { return corners_.size() / 3; }
    std::size_t degenerate_triangles() const { return degenerate_; }
    /// The mesh, without unused vertices. Leaves the builder empty.
    Mesh finish();

private:
    std::size_t slot(const double* point) const;
    void grow();

    std::vector<double> points_;   // x, y, z of vertex 0, 1, ...
    std::vector<int> corners_;     // three a triangle
    std::vector<int> table_;       // open addressing, vertex index or -1; its size is a power of two
    std::size_t degenerate_ = 0;
};

}  // namespace ribvault
