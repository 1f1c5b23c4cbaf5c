// A mesh traced by Embree, one thread, for the race: packets of 16 rays on blocks of 4x4 pixels, coherent, on a BVH of high
// quality. Reads what ../race/embree.py writes into a folder; speaks the protocol of ../README.md on standard input and output.

#include <embree3/rtcore.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

constexpr int BLOCK = 4, LANES = 16;

struct Vec {
    float x, y, z;
};

double seconds(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Processor time and time on the wall.
struct Clock {
    double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID), wall = seconds(CLOCK_MONOTONIC);
    void print(const char *more = "") const {
        std::printf("{\"cpu_s\": %.9f, \"wall_s\": %.9f%s}\n", seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu,
                    seconds(CLOCK_MONOTONIC) - wall, more);
        std::fflush(stdout);
    }
};

template <typename T> std::vector<T> load(const std::string &path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    std::vector<T> values(file ? size_t(file.tellg()) / sizeof(T) : 0);
    file.seekg(0);
    file.read(reinterpret_cast<char *>(values.data()), std::streamsize(values.size() * sizeof(T)));
    return values;
}

// Where the picture is taken from: `right` and `up` lead from the middle of the film, at distance 1, to its edges.
struct View {
    int width = 0, height = 0;
    Vec eye{}, right{}, up{}, ahead{}, light{};
};

View load_view(const std::string &path) {
    std::ifstream file(path);
    View v;
    file >> v.width >> v.height;
    for (Vec *p : {&v.eye, &v.right, &v.up, &v.ahead, &v.light}) file >> p->x >> p->y >> p->z;
    return v;
}

RTCScene build(RTCDevice device, const std::string &folder) {
    const auto points = load<float>(folder + "/points.f32");
    const auto triangles = load<uint32_t>(folder + "/triangles.u32");
    const auto offsets = load<float>(folder + "/offsets.f32");
    RTCScene mesh = rtcNewScene(device);
    rtcSetSceneBuildQuality(mesh, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto *p = static_cast<float *>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                           3 * sizeof(float), points.size() / 3));
    std::copy(points.begin(), points.end(), p);
    auto *t = static_cast<uint32_t *>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                              3 * sizeof(uint32_t), triangles.size() / 3));
    std::copy(triangles.begin(), triangles.end(), t);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(mesh, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(mesh);
    if (offsets.empty()) return mesh;

    RTCScene copies = rtcNewScene(device);
    rtcSetSceneBuildQuality(copies, RTC_BUILD_QUALITY_HIGH);
    for (size_t i = 0; i + 2 < offsets.size(); i += 3) {
        RTCGeometry copy = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(copy, mesh);
        const float map[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, offsets[i], offsets[i + 1], offsets[i + 2]};
        rtcSetGeometryTransform(copy, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, map);
        rtcCommitGeometry(copy);
        rtcAttachGeometry(copies, copy);
        rtcReleaseGeometry(copy);
    }
    rtcCommitScene(copies);
    return copies;
}

// What is stored of a picture, pixels in order of blocks: distances (infinite on a miss), unit normals, light that arrives.
struct Film {
    std::vector<float> t, nx, ny, nz, lit;
    explicit Film(size_t pixels) : t(pixels), nx(pixels), ny(pixels), nz(pixels), lit(pixels) {}
};

struct Tracer {
    RTCScene scene;
    View view;

    // Calls `each` with the first pixel of every block and the directions of its rays.
    template <typename Each> void blocks(Each each) const {
        alignas(64) float dx[LANES], dy[LANES], dz[LANES];
        size_t start = 0;
        for (int top = 0; top < view.height; top += BLOCK) {
            for (int left = 0; left < view.width; left += BLOCK, start += LANES) {
                for (int lane = 0; lane < LANES; ++lane) {
                    const float x = (float(left + lane % BLOCK) + 0.5f) / float(view.width) * 2.0f - 1.0f;
                    const float y = 1.0f - (float(top + lane / BLOCK) + 0.5f) / float(view.height) * 2.0f;
                    const float a = view.ahead.x + x * view.right.x + y * view.up.x;
                    const float b = view.ahead.y + x * view.right.y + y * view.up.y;
                    const float c = view.ahead.z + x * view.right.z + y * view.up.z;
                    const float scale = 1.0f / std::sqrt(a * a + b * b + c * c);
                    dx[lane] = a * scale, dy[lane] = b * scale, dz[lane] = c * scale;
                }
                each(start, dx, dy, dz);
            }
        }
    }

    void draw(Film &film) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        alignas(64) int valid[LANES];
        std::fill(valid, valid + LANES, -1);
        blocks([&](size_t start, const float *dx, const float *dy, const float *dz) {
            RTCRayHit16 packet;
            for (int i = 0; i < LANES; ++i) {
                packet.ray.org_x[i] = view.eye.x, packet.ray.org_y[i] = view.eye.y, packet.ray.org_z[i] = view.eye.z;
                packet.ray.dir_x[i] = dx[i], packet.ray.dir_y[i] = dy[i], packet.ray.dir_z[i] = dz[i];
                packet.ray.tnear[i] = 0.0f, packet.ray.tfar[i] = INFINITY, packet.ray.time[i] = 0.0f;
                packet.ray.mask[i] = ~0u, packet.ray.flags[i] = 0, packet.ray.id[i] = 0;
                packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID, packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
            }
            rtcIntersect16(valid, scene, &context, &packet);
            for (int i = 0; i < LANES; ++i) {
                const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
                const float x = packet.hit.Ng_x[i], y = packet.hit.Ng_y[i], z = packet.hit.Ng_z[i];
                const float scale = hit ? 1.0f / std::sqrt(x * x + y * y + z * z) : 0.0f;
                film.t[start + i] = hit ? packet.ray.tfar[i] : INFINITY;
                film.nx[start + i] = hit ? x * scale : 0.0f;
                film.ny[start + i] = hit ? y * scale : 0.0f;
                film.nz[start + i] = hit ? z * scale : 0.0f;
            }
        });
    }

    // From every hit that faces the light a ray to it; returns how many.
    size_t shade(Film &film) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        // Marked coherent, packets of 3.13.5 never come back from some scenes of instances; and they are no faster.
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        size_t rays = 0;
        blocks([&](size_t start, const float *dx, const float *dy, const float *dz) {
            RTCRay16 packet;
            alignas(64) int valid[LANES];
            int count = 0;
            for (int i = 0; i < LANES; ++i) {
                const size_t p = start + i;
                const float t = std::isinf(film.t[p]) ? 0.0f : film.t[p];
                const float off = 1e-4f * t;
                const float x = view.eye.x + t * dx[i] + off * film.nx[p];
                const float y = view.eye.y + t * dy[i] + off * film.ny[p];
                const float z = view.eye.z + t * dz[i] + off * film.nz[p];
                const float lx = view.light.x - x, ly = view.light.y - y, lz = view.light.z - z;
                const bool faces = film.nx[p] * lx + film.ny[p] * ly + film.nz[p] * lz > 0.0f;
                valid[i] = faces ? -1 : 0;
                count += faces;
                packet.org_x[i] = x, packet.org_y[i] = y, packet.org_z[i] = z;
                packet.dir_x[i] = lx, packet.dir_y[i] = ly, packet.dir_z[i] = lz;
                packet.tnear[i] = 0.0f, packet.tfar[i] = 1.0f, packet.time[i] = 0.0f;
                packet.mask[i] = ~0u, packet.flags[i] = 0, packet.id[i] = 0;
            }
            rays += size_t(count);
            if (count > 0) rtcOccluded16(valid, scene, &context, &packet);
            for (int i = 0; i < LANES; ++i) {
                film.lit[start + i] = valid[i] && packet.tfar[i] >= 0.0f ? 1.0f : 0.0f;
            }
        });
        return rays;
    }

    // Distance and normal of every pixel, row by row.
    void dump(const Film &film, const std::string &path) const {
        std::vector<float> rows(4 * film.t.size());
        const int across = view.width / BLOCK;
        for (size_t p = 0; p < film.t.size(); ++p) {
            const int block = int(p / LANES), lane = int(p % LANES);
            const int x = block % across * BLOCK + lane % BLOCK, y = block / across * BLOCK + lane / BLOCK;
            float *pixel = &rows[4 * (size_t(y) * size_t(view.width) + size_t(x))];
            pixel[0] = film.t[p], pixel[1] = film.nx[p], pixel[2] = film.ny[p], pixel[3] = film.nz[p];
        }
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char *>(rows.data()), std::streamsize(rows.size() * sizeof(float)));
    }
};

} // namespace

int main(int count, char **words) {
    if (count != 2) {
        std::fprintf(stderr, "usage: %s FOLDER\n", words[0]);
        return 2;
    }
    const std::string folder = words[1];
    const Clock whole;
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    const Tracer tracer{build(device, folder), load_view(folder + "/view.txt")};
    Film film(size_t(tracer.view.width) * size_t(tracer.view.height));
    whole.print();

    std::string command;
    while (std::cin >> command) {
        if (command == "frame") {
            const Clock clock;
            tracer.draw(film);
            clock.print();
        } else if (command == "shadow") {
            tracer.draw(film);
            const Clock clock;
            const size_t rays = tracer.shade(film);
            clock.print((", \"rays\": " + std::to_string(rays)).c_str());
        } else if (command == "dump") {
            std::string path;
            std::cin >> path;
            tracer.draw(film);
            tracer.dump(film, path);
            Clock().print();
        }
    }
}
