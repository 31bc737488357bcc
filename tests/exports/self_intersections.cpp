// Counts the pairs of triangles of an OFF file that cross or touch, except at common edges and vertices, by CGAL's
// exact predicates. Prints "PAIRS FACES"; PAIRS is -1 if the triangles do not form a manifold surface.
//
//     g++ -O2 -o self_intersections self_intersections.cpp -lgmp -lmpfr
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

int main(int, char** arguments) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    namespace processing = CGAL::Polygon_mesh_processing;

    std::ifstream file(arguments[1]);
    std::string format;
    std::size_t vertices = 0, faces = 0, edges = 0;
    if (!(file >> format >> vertices >> faces >> edges) || format != "OFF") return 1;
    std::vector<Kernel::Point_3> points;
    for (std::size_t i = 0; i < vertices; ++i) {
        double x = 0, y = 0, z = 0;
        file >> x >> y >> z;
        points.emplace_back(x, y, z);
    }
    std::vector<std::array<std::size_t, 3>> triangles(faces);
    for (auto& t : triangles) {
        std::size_t corners = 0;
        file >> corners >> t[0] >> t[1] >> t[2];
    }
    if (!file) return 1;
    if (!processing::is_polygon_soup_a_polygon_mesh(triangles)) {
        std::cout << "-1 " << faces << "\n";
        return 0;
    }
    Surface surface;
    processing::polygon_soup_to_polygon_mesh(points, triangles, surface);
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
    processing::self_intersections(surface, std::back_inserter(pairs));
    std::cout << pairs.size() << " " << surface.number_of_faces() << "\n";
}
