#include "src/partition/patch.h"

#include <algorithm>
#include <unordered_map>

namespace geodesic {

std::vector<uint32_t> vertices_of(const Mesh& mesh, std::span<const uint32_t> faces) {
    std::vector<uint32_t> vertices;
    vertices.reserve(faces.size() * 3);
    for (uint32_t f : faces) vertices.insert(vertices.end(), mesh.faces[f].begin(), mesh.faces[f].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

FaceGroups connected_groups(const Mesh& mesh, std::span<const uint32_t> faces,
                            std::span<const uint32_t> label) {
    std::unordered_map<uint32_t, uint32_t> position;
    position.reserve(faces.size());
    for (uint32_t i = 0; i < faces.size(); ++i) position.emplace(faces[i], i);

    FaceGroups groups;
    groups.of_face.assign(faces.size(), NONE);
    std::vector<uint32_t> stack;
    for (uint32_t start = 0; start < faces.size(); ++start) {
        if (groups.of_face[start] != NONE) continue;
        groups.of_face[start] = groups.count;
        stack.push_back(start);
        while (!stack.empty()) {
            const uint32_t i = stack.back();
            stack.pop_back();
            for (uint32_t e : mesh.face_edges[faces[i]])
                for (uint32_t g : mesh.edge_faces[e]) {
                    const auto found = position.find(g);
                    if (found == position.end()) continue;
                    const uint32_t j = found->second;
                    if (groups.of_face[j] != NONE || label[j] != label[i]) continue;
                    groups.of_face[j] = groups.count;
                    stack.push_back(j);
                }
        }
        ++groups.count;
    }
    return groups;
}

}
