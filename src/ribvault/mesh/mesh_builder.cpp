#include "ribvault/mesh/mesh_builder.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "ribvault/error.hpp"

namespace ribvault {
namespace {

/// Floats widened to doubles differ in their high bits only, so every step folds these down.
std::uint64_t mixed(std::uint64_t h, double value) {
    h = (h ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15u;
    return h ^ (h >> 32);
}

}  // namespace

void MeshBuilder::reserve(std::size_t triangles) {
    corners_.reserve(3 * triangles);
    points_.reserve(3 * (triangles / 2 + 2));  // Euler: a closed surface has about half as many vertices as triangles
    table_.reserve(std::bit_ceil(triangles + 4));
}

std::size_t MeshBuilder::slot(const double* point) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = mixed(mixed(mixed(0, point[0]), point[1]), point[2]) & mask;
    while (table_[at] >= 0 && !std::equal(point, point + 3, &points_[3 * static_cast<std::size_t>(table_[at])]))
        at = (at + 1) & mask;
    return at;
}

void MeshBuilder::grow() {
    const std::size_t count = points_.size() / 3;
    if (count >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw Error(ErrorKind::unreadable, "the mesh has more than 2147483647 vertices; simplify it first");
    if (2 * (count + 1) <= table_.size()) return;
    table_.assign(std::max<std::size_t>({64, std::bit_ceil(4 * count), std::bit_floor(table_.capacity())}), -1);
    for (std::size_t i = 0; i < count; ++i) table_[slot(&points_[3 * i])] = static_cast<int>(i);
}

int MeshBuilder::vertex(double x, double y, double z) {
    grow();
    const double point[3] = {x + 0.0, y + 0.0, z + 0.0};  // -0 + 0 is 0
    int& entry = table_[slot(point)];
    if (entry < 0) {
        entry = static_cast<int>(points_.size() / 3);
        points_.insert(points_.end(), point, point + 3);
    }
    return entry;
}

void MeshBuilder::triangle(int a, int b, int c) {
    if (a == b || b == c || c == a) {
        ++degenerate_;
        return;
    }
    corners_.insert(corners_.end(), {a, b, c});
}

void MeshBuilder::polygon(std::span<const int> corners) {
    if (corners.size() < 3) ++degenerate_;
    for (std::size_t k = 2; k < corners.size(); ++k) triangle(corners[0], corners[k - 1], corners[k]);
}

Mesh MeshBuilder::finish() {
    std::vector<int> kept(points_.size() / 3, -1);
    for (int corner : corners_) kept[static_cast<std::size_t>(corner)] = 0;
    int count = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i] == 0) {
            std::copy_n(&points_[3 * i], 3, &points_[3 * static_cast<std::size_t>(count)]);
            kept[i] = count++;
        }
    for (int& corner : corners_) corner = kept[static_cast<std::size_t>(corner)];
    Mesh mesh;
    mesh.vertices = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>(points_.data(), 3, count);
    mesh.triangles = Eigen::Map<const Eigen::Matrix<int, 3, Eigen::Dynamic>>(
        corners_.data(), 3, static_cast<Eigen::Index>(corners_.size() / 3));
    mesh.degenerate_triangles = degenerate_;
    *this = MeshBuilder();
    return mesh;
}

}  // namespace ribvault
