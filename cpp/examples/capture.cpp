// The core without Python: builds a scene, captures it into a cubemap, and writes six faces.
//
//     cubecam_capture_example OUT_DIR
//
// The example writes OUT_DIR/face_0.pfm ... face_5.pfm in the order +X -X +Y -Y +Z -Z, as linear
// RGB floats. The rows of a PFM file go from bottom to top, so a picture viewer shows row 0 of the
// face (t = 0) on top.
#include "cubecam/geometry/primitives.hpp"
#include "cubecam/materials/basic.hpp"
#include "cubecam/materials/mirror.hpp"
#include "cubecam/materials/phong.hpp"
#include "cubecam/math/cube_face.hpp"
#include "cubecam/render/renderer.hpp"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

namespace {

using namespace cubecam;

std::shared_ptr<Node> add(Scene& scene, MeshData mesh, std::shared_ptr<Material> material,
                          glm::dvec3 position) {
    NodeValue node;
    node.mesh = std::make_shared<Mesh>(std::move(mesh));
    node.material = std::move(material);
    node.placing = Transform{position};
    return scene.add(std::move(node));
}

void build(Scene& scene) {
    scene.set_background(glm::vec4(0.4F, 0.4F, 0.4F, 1.0F));
    scene.add(std::make_shared<PointLight>(PointParameters{{5.0, 5.0, 5.0}}));

    Phong floor;
    floor.color = {0.4F, 0.4F, 1.0F, 1.0F};
    add(scene, primitives::plane(10.0, 10.0), std::make_shared<PhongMaterial>(floor),
        {0.0, -2.0, 0.0});
    Phong green;
    green.color = {0.4F, 1.0F, 0.4F, 1.0F};
    add(scene, primitives::box(glm::dvec3(1.0)), std::make_shared<PhongMaterial>(green),
        {2.0, 0.0, 0.5});
    Basic red;
    red.color = {1.0F, 0.4F, 0.4F, 1.0F};
    add(scene, primitives::sphere(0.5), std::make_shared<BasicMaterial>(red), {-0.5, 0.25, -2.0});

    // A mirror ball that shows the other objects, by a probe of its own.
    const auto ball =
        add(scene, primitives::sphere(0.75), std::make_shared<MirrorMaterial>(), {0.0, 0.5, 2.5});
    ProbeValue probe;
    probe.position = {0.0, 0.5, 2.5};
    ball->edit([&](NodeValue& value) { value.environment = std::make_shared<Probe>(probe); });
}

void write_pfm(const std::filesystem::path& path, const CubeMapData& cube, Face face) {
    const auto size = static_cast<std::size_t>(cube.size);
    const auto* texels = reinterpret_cast<const float*>(cube.face_pixels(face).data());
    std::ofstream file(path, std::ios::binary);
    file << "PF\n" << size << ' ' << size << "\n-1.0\n";
    for (std::size_t row = size; row-- > 0;) {
        for (std::size_t column = 0; column < size; ++column) {
            file.write(reinterpret_cast<const char*>(texels + (row * size + column) * 4),
                       3 * sizeof(float));
        }
    }
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: " << arguments[0] << " OUT_DIR\n";
        return 2;
    }
    try {
        const std::filesystem::path out = arguments[1];
        std::filesystem::create_directories(out);
        Scene scene;
        build(scene);

        Renderer renderer;
        CaptureOptions options;
        options.size = 64;
        const auto cube = renderer.capture(scene, options);
        for (const Face face : all_faces) {
            write_pfm(out / ("face_" + std::to_string(face_index(face)) + ".pfm"), *cube->data(),
                      face);
        }
        const Stats stats = renderer.stats();
        std::cout << renderer.info().renderer << ": " << stats.views_drawn << " views, "
                  << stats.draw_calls << " draw calls, " << stats.milliseconds << " ms, written to "
                  << out.string() << '\n';
        return 0;
    } catch (const std::exception& problem) {
        std::cerr << problem.what() << '\n';
        return 1;
    }
}
