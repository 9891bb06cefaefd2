// OpenMeshVdpm: OpenMesh's view-dependent progressive mesh, driven by its published classes, to be measured beside ours.
//
// Its own program for that draws in a window; the library holds hierarchy, front and mesh operations, and leaves the
// frame's loop to the caller. Here it is Hoppe's (1997): every node of the front in turn is split when its error is too
// large, or collapsed with its sibling when their parent's is not.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/VDPM/MeshTraits.hh>
#include <OpenMesh/Tools/VDPM/VFront.hh>
#include <OpenMesh/Tools/VDPM/VHierarchy.hh>
#include <OpenMesh/Tools/VDPM/ViewingParameters.hh>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <span>

#include "lod/view.h"

namespace bench {

class OpenMeshVdpm {
  public:
    /// @param bytes  an .spm file, as OpenMesh-Analyzer writes it
    bool read(std::span<const std::byte> bytes) {
        rest_ = bytes.subspan(std::min<size_t>(bytes.size(), 10));
        const auto roots = take<uint32_t>(), faces = take<uint32_t>(), details = take<uint32_t>();
        if (bytes.size() < 22 || std::memcmp(bytes.data(), "VDProgMesh", 10) != 0) return false;
        hierarchy_.set_num_roots(roots);
        NodeHandles handles;
        for (uint32_t i = 0; i < roots; ++i) {
            const Vertex vertex = mesh_.add_vertex(take_vector());
            const NodeHandle handle = hierarchy_.add_node();
            hierarchy_.node(handle).set_index(hierarchy_.generate_node_index(i, 1));
            hierarchy_.node(handle).set_vertex_handle(vertex);
            mesh_.data(vertex).set_vhierarchy_node_handle(handle);
            take_bounds(handle);
            known_[hierarchy_.node_index(handle)] = handle;
            handles.push_back(handle);
        }
        front_.init(handles, details);
        for (uint32_t i = 0; i < faces; ++i) {
            const auto face = take<std::array<uint32_t, 3>>();
            mesh_.add_face(Vertex(int(face[0])), Vertex(int(face[1])), Vertex(int(face[2])));
        }
        for (uint32_t i = 0; i < details; ++i)
            take_split();
        return rest_.empty();
    }

    /// One frame. @param view  in the file's frame
    void adapt(const lod::View& view, double tolerance_px) {
        look(view, tolerance_px);
        for (front_.begin(); !front_.end();) {
            const NodeHandle node = front_.node_handle(), parent = hierarchy_.parent_handle(node);
            if (!hierarchy_.is_leaf_node(node) && is_too_coarse(node)) {
                split(node);
            } else if (!hierarchy_.is_root_node(node) && collapse(parent)) {
            } else {
                front_.next();
            }
        }
    }
    /// Splits until nothing is left to split, without a look at any view.
    void refine_fully() {
        for (front_.begin(); !front_.end();) {
            const NodeHandle node = front_.node_handle();
            if (hierarchy_.is_leaf_node(node))
                front_.next();
            else
                split(node);
        }
    }
    /// Frees what was collapsed, as its program does after every frame.
    void clean() {
        mesh_.garbage_collection(false, true, true);
        mesh_.update_face_normals();
    }
    size_t triangles() const { return mesh_.n_faces(); }
    uint64_t operations() const { return operations_; }

  private:
    using Mesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::VDPM::MeshTraits>;
    using Vertex = Mesh::VertexHandle;
    using NodeHandle = OpenMesh::VDPM::VHierarchyNodeHandle;
    using NodeHandles = OpenMesh::VDPM::VHierarchyNodeHandleContainer;
    using NodeIndex = OpenMesh::VDPM::VHierarchyNodeIndex;

    template <typename Value>
    Value take() {
        Value value{};
        if (rest_.size() < sizeof(Value)) return value;
        std::memcpy(&value, rest_.data(), sizeof(Value));
        rest_ = rest_.subspan(sizeof(Value));
        return value;
    }
    OpenMesh::Vec3f take_vector() {
        const auto [x, y, z] = take<std::array<float, 3>>();
        return {x, y, z};
    }
    void take_bounds(NodeHandle handle) {
        OpenMesh::VDPM::VHierarchyNode& node = hierarchy_.node(handle);
        node.set_radius(take<float>());
        node.set_normal(take_vector());
        node.set_sin_square(take<float>());
        node.set_mue_square(take<float>());
        node.set_sigma_square(take<float>());
    }
    void take_split() {
        const Vertex vertex = mesh_.add_vertex(take_vector());
        NodeHandle handle = known_[NodeIndex(take<uint32_t>())];
        hierarchy_.make_children(handle);
        OpenMesh::VDPM::VHierarchyNode& node = hierarchy_.node(handle);
        node.set_fund_lcut(NodeIndex(take<uint32_t>()));
        node.set_fund_rcut(NodeIndex(take<uint32_t>()));
        const NodeHandle left = node.lchild_handle(), right = node.rchild_handle();
        hierarchy_.node(left).set_vertex_handle(vertex);
        hierarchy_.node(right).set_vertex_handle(node.vertex_handle());
        for (const NodeHandle child : {left, right}) {
            known_[hierarchy_.node_index(child)] = child;
            take_bounds(child);
        }
    }

    void look(const lod::View& view, double tolerance_px) {
        std::array<double, 16> matrix{};
        const glm::dvec3 shift = -(view.eye_from_world * view.eye_world);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row)
                matrix[static_cast<size_t>(4 * column + row)] =
                    column < 3 ? view.eye_from_world[column][row] : shift[row];
        }
        matrix[15] = 1.0;
        eye_.set_modelview_matrix(matrix.data());
        eye_.set_aspect(float(view.width_px) / float(view.height_px));
        eye_.set_fovy(float(view.fov_y_rad));
        eye_.update_viewing_configurations();
        eye_.frustum_planes(planes_.data());
        // Two of the four face outwards in OpenMesh 9: then nothing would be in view.
        for (size_t i = 0; i < planes_.size(); ++i)
            inward_[i] = planes_[i].singed_distance(eye_.eye_pos() + eye_.view_dir()) < 0.0f ? -1.0f : 1.0f;
        const double slope = 2.0 * std::tan(0.5 * view.fov_y_rad) * tolerance_px / view.height_px;
        tolerance2_ = float(slope * slope);
    }

    /// In view, not turned away, and its error of more than the tolerance.
    bool is_too_coarse(NodeHandle handle) {
        const OpenMesh::VDPM::VHierarchyNode& node = hierarchy_.node(handle);
        const OpenMesh::Vec3f place = mesh_.point(node.vertex_handle()), ray = place - eye_.eye_pos();
        for (size_t i = 0; i < planes_.size(); ++i) {
            if (inward_[i] * planes_[i].singed_distance(place) < -node.radius()) return false;
        }
        const float far2 = ray.sqrnorm(), along = ray | node.normal(), along2 = along * along;
        if (along > 0.0f && along2 > far2 * node.sin_square()) return false;
        return node.mue_square() >= tolerance2_ * far2 ||
               node.sigma_square() * (far2 - along2) >= tolerance2_ * far2 * far2;
    }

    /// The two vertices between which a node opens; the same when another must be split first.
    std::array<Vertex, 2> cuts(NodeHandle node) {
        std::array<Vertex, 2> found;
        const std::array<NodeIndex, 2> wanted{hierarchy_.fund_lcut_index(node),
                                              hierarchy_.fund_rcut_index(node)};
        for (auto it = mesh_.vv_iter(hierarchy_.vertex_handle(node)); it.is_valid(); ++it) {
            const NodeIndex beside = hierarchy_.node_index(mesh_.data(*it).vhierarchy_node_handle());
            for (size_t side = 0; side < 2; ++side) {
                if (!found[side].is_valid() && hierarchy_.is_ancestor(beside, wanted[side]))
                    found[side] = *it;
            }
            if (found[0].is_valid() && found[1].is_valid()) break;
        }
        return found;
    }

    void split(NodeHandle node) {
        std::array<Vertex, 2> beside = cuts(node);
        while (beside[0] == beside[1]) {
            split(mesh_.data(beside[0]).vhierarchy_node_handle());
            beside = cuts(node);
        }
        const std::array<NodeHandle, 2> children{hierarchy_.lchild_handle(node),
                                                 hierarchy_.rchild_handle(node)};
        const Vertex left = hierarchy_.vertex_handle(children[0]),
                     right = hierarchy_.vertex_handle(children[1]);
        mesh_.vertex_split(left, right, beside[0], beside[1]);
        front_.remove(node);
        for (const NodeHandle child : children) {
            const Vertex vertex = hierarchy_.vertex_handle(child);
            mesh_.set_normal(vertex, hierarchy_.normal(child));
            mesh_.data(vertex).set_vhierarchy_node_handle(child);
            mesh_.status(vertex).set_deleted(false);
            front_.add(child);
        }
        ++operations_;
    }

    /// False when it is not legal, or its error too large.
    bool collapse(NodeHandle node) {
        const NodeHandle left = hierarchy_.lchild_handle(node), right = hierarchy_.rchild_handle(node);
        if (!front_.is_active(left) || !front_.is_active(right)) return false;
        const Vertex from = hierarchy_.vertex_handle(left), to = hierarchy_.vertex_handle(right);
        const auto side = mesh_.find_halfedge(from, to);
        if (!mesh_.is_collapse_ok(side) || is_too_coarse(node)) return false;
        mesh_.collapse(side);
        mesh_.set_normal(to, hierarchy_.normal(node));
        mesh_.data(to).set_vhierarchy_node_handle(node);
        mesh_.status(from).set_deleted(false);
        mesh_.status(to).set_deleted(false);
        front_.add(node);
        front_.remove(left);
        front_.remove(right);
        ++operations_;
        return true;
    }

    std::span<const std::byte> rest_;
    Mesh mesh_;
    OpenMesh::VDPM::VHierarchy hierarchy_;
    OpenMesh::VDPM::VFront front_;
    OpenMesh::VDPM::ViewingParameters eye_;
    std::array<OpenMesh::VDPM::Plane3d, 4> planes_;
    std::array<float, 4> inward_{};
    std::map<NodeIndex, NodeHandle> known_;
    float tolerance2_ = 0.0f;
    uint64_t operations_ = 0;
};

}  // namespace bench
