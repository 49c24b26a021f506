// The records that cross the border between CPU and GL, each with the code that takes it apart and puts it
// together on both sides: what tests/gpu/layout.cpp runs.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "shared/interface/records.h"
#include "shared/math/alias_table.h"
#include "shared/math/light.h"
#include "shared/math/light_sample.h"
#include "shared/math/reservoir.h"

namespace tarn::test {

using Words = std::vector<std::uint32_t>;  // the fields of a record, one after the other
using Rows = std::vector<glm::uvec4>;

// Takes the fields of one record out of words, and puts them back: what the shaders below do in GLSL.
class FieldReader {
  public:
    explicit FieldReader(const std::uint32_t* words) : next_(words) {}
    std::uint32_t take() { return *next_++; }
    float take1() { return uintBitsToFloat(take()); }
    vec2 take2() {
        const float x = take1();
        return vec2(x, take1());
    }
    vec3 take3() {
        const vec2 xy = take2();
        return vec3(xy, take1());
    }
    vec4 take4() {
        const vec3 xyz = take3();
        return vec4(xyz, take1());
    }

  private:
    const std::uint32_t* next_;
};

class FieldWriter {
  public:
    void put(std::uint32_t word) { words.push_back(word); }
    void put(float value) { put(floatBitsToUint(value)); }
    void put(const vec2& v) { put(v.x), put(v.y); }
    void put(const vec3& v) { put(v.x), put(v.y), put(v.z); }
    void put(const vec4& v) { put(vec3(v)), put(v.w); }

    Words words;
};

struct Record {
    std::string name;
    std::uint32_t rows;
    std::string fields;       // 'f': a number, 'u': a word, 'n': a multiple of 1 / 65535 in [0, 1]
    std::string glsl_unpack;  // row(i) -> put(field) in order
    std::string glsl_pack;    // take*() in order -> store(i, row); empty: shaders never write this record
    std::function<void(FieldReader&, glm::uvec4*)> pack;          // empty: C++ packs it elsewhere
    std::function<void(const glm::uvec4*, FieldWriter&)> unpack;  // empty: C++ never reads it
};

inline void PrintTo(const Record& record, std::ostream* out) {
    *out << record.name;
}

inline Record vertex_record() {
    Record r{"vertex", VERTEX_ROWS, "ffffffffffffffnnnn", {}, {}, {}, {}};
    // As scene/surface.h takes vertices apart.
    r.glsl_unpack = R"(
        put(row_xyz(row(0u))); put(row_xyz(row(1u))); put(row_xyzw(row(2u)));
        put(uintBitsToFloat(row(0u).w)); put(uintBitsToFloat(row(1u).w));
        put(uintBitsToFloat(row(3u).x)); put(uintBitsToFloat(row(3u).y));
        put(unpackUnorm2x16(row(3u).z)); put(unpackUnorm2x16(row(3u).w));)";
    r.glsl_pack = R"(
        Vertex v; v.position_os = take3(); v.normal_os = take3(); v.tangent_os = take4(); v.uv0 = take2();
        v.uv1 = take2(); v.color = take4();
        uvec4 a, b, c, d; pack_vertex(v, a, b, c, d); store(0u, a); store(1u, b); store(2u, c); store(3u, d);)";
    r.pack = [](FieldReader& in, glm::uvec4* rows) {
        Vertex v;
        v.position_os = in.take3();
        v.normal_os = in.take3();
        v.tangent_os = in.take4();
        v.uv0 = in.take2();
        v.uv1 = in.take2();
        v.color = in.take4();
        pack_vertex(v, rows[0], rows[1], rows[2], rows[3]);
    };
    r.unpack = [](const glm::uvec4* rows, FieldWriter& out) {
        out.put(row_xyz(rows[0]));
        out.put(row_xyz(rows[1]));
        out.put(row_xyzw(rows[2]));
        for (const std::uint32_t word : {rows[0].w, rows[1].w, rows[3].x, rows[3].y}) out.put(word);
        out.put(unpackUnorm2x16(rows[3].z));
        out.put(unpackUnorm2x16(rows[3].w));
    };
    return r;
}

inline Record material_record() {
    Record r{"material", 4, "fffffffffffuffff", {}, {}, {}, {}};
    r.glsl_unpack = R"(
        MaterialRecord m = unpack_material(row(0u), row(1u), row(2u), row(3u));
        put(m.base_color); put(m.emission); put(m.alpha_cutoff); put(m.metallic); put(m.roughness);
        put(m.normal_scale); put(m.flags); put(m.dielectric_f0); put(m.dielectric_f90);)";
    r.glsl_pack = R"(
        MaterialRecord m; m.base_color = take4(); m.emission = take3(); m.alpha_cutoff = take1(); m.metallic = take1();
        m.roughness = take1(); m.normal_scale = take1(); m.flags = take(); m.dielectric_f0 = take3();
        m.dielectric_f90 = take1();
        uvec4 a, b, c, d; pack_material(m, a, b, c, d); store(0u, a); store(1u, b); store(2u, c); store(3u, d);)";
    r.pack = [](FieldReader& in, glm::uvec4* rows) {
        MaterialRecord m;
        m.base_color = in.take4();
        m.emission = in.take3();
        m.alpha_cutoff = in.take1();
        m.metallic = in.take1();
        m.roughness = in.take1();
        m.normal_scale = in.take1();
        m.flags = in.take();
        m.dielectric_f0 = in.take3();
        m.dielectric_f90 = in.take1();
        pack_material(m, rows[0], rows[1], rows[2], rows[3]);
    };
    r.unpack = [](const glm::uvec4* rows, FieldWriter& out) {
        const MaterialRecord m = unpack_material(rows[0], rows[1], rows[2], rows[3]);
        out.put(m.base_color);
        out.put(m.emission);
        for (const float f : {m.alpha_cutoff, m.metallic, m.roughness, m.normal_scale}) out.put(f);
        out.put(m.flags);
        out.put(m.dielectric_f0);
        out.put(m.dielectric_f90);
    };
    return r;
}

inline Record slot_record() {
    Record r{"slot", 2, "uuufffff", {}, {}, {}, {}};
    r.glsl_unpack = R"(
        SlotRecord s = unpack_slot(row(0u), row(1u));
        put(s.first_texel); put(s.size); put(s.flags); put(s.rotation_rad); put(s.offset); put(s.scale);)";
    r.glsl_pack = R"(
        SlotRecord s; s.first_texel = take(); s.size = take(); s.flags = take(); s.rotation_rad = take1();
        s.offset = take2(); s.scale = take2();
        uvec4 a, b; pack_slot(s, a, b); store(0u, a); store(1u, b);)";
    r.pack = [](FieldReader& in, glm::uvec4* rows) {
        SlotRecord s;
        s.first_texel = in.take();
        s.size = in.take();
        s.flags = in.take();
        s.rotation_rad = in.take1();
        s.offset = in.take2();
        s.scale = in.take2();
        pack_slot(s, rows[0], rows[1]);
    };
    r.unpack = [](const glm::uvec4* rows, FieldWriter& out) {
        const SlotRecord s = unpack_slot(rows[0], rows[1]);
        for (const std::uint32_t word : {s.first_texel, s.size, s.flags}) out.put(word);
        out.put(s.rotation_rad);
        out.put(s.offset);
        out.put(s.scale);
    };
    return r;
}

inline Record light_record() {
    Record r{"light", LIGHT_ROWS, "fffufffufffuffff", {}, {}, {}, {}};
    r.glsl_unpack = R"(
        Light l = unpack_light(row(0u), row(1u), row(2u), row(3u));
        put(l.position); put(l.flags | floatBitsToUint(l.position_error)); put(l.edge1); put(l.instance);
        put(l.edge2); put(l.primitive); put(l.radiance); put(l.range);)";
    r.glsl_pack = R"(
        Light l; l.position = take3(); uint word = take(); l.flags = word & LIGHT_FLAG_BITS;
        l.position_error = uintBitsToFloat(word & ~LIGHT_FLAG_BITS); l.edge1 = take3(); l.instance = take();
        l.edge2 = take3(); l.primitive = take(); l.radiance = take3(); l.range = take1();
        uvec4 a, b, c, d; pack_light(l, a, b, c, d); store(0u, a); store(1u, b); store(2u, c); store(3u, d);)";
    r.pack = [](FieldReader& in, glm::uvec4* rows) {
        Light l;
        l.position = in.take3();
        const std::uint32_t word = in.take();
        l.flags = word & LIGHT_FLAG_BITS;
        l.position_error = uintBitsToFloat(word & ~LIGHT_FLAG_BITS);
        l.edge1 = in.take3();
        l.instance = in.take();
        l.edge2 = in.take3();
        l.primitive = in.take();
        l.radiance = in.take3();
        l.range = in.take1();
        pack_light(l, rows[0], rows[1], rows[2], rows[3]);
    };
    r.unpack = [](const glm::uvec4* rows, FieldWriter& out) {
        const Light l = unpack_light(rows[0], rows[1], rows[2], rows[3]);
        out.put(l.position), out.put(l.flags | floatBitsToUint(l.position_error));
        out.put(l.edge1), out.put(l.instance);
        out.put(l.edge2), out.put(l.primitive);
        out.put(l.radiance), out.put(l.range);
    };
    return r;
}

inline Record reservoir_record() {
    Record r{"reservoir", RESERVOIR_ROWS, "ufffffff", {}, {}, {}, {}};
    r.glsl_unpack = R"(
        LightSample chosen = unpack_light_sample(row(0u).xyz);
        Reservoir r = unpack_reservoir(row(0u), row(1u));
        put(chosen.light); put(chosen.uv); put(r.contribution_weight); put(r.confidence);
        put(r.target); put(r.visibility); put(r.age);)";
    r.glsl_pack = R"(
        LightSample chosen; Reservoir r;
        chosen.light = take(); chosen.uv = take2(); r.contribution_weight = take1();
        r.confidence = take1(); r.target = take1(); r.visibility = take1(); r.age = take1();
        uvec4 a, b; pack_reservoir(r, pack_light_sample(chosen), a, b); store(0u, a); store(1u, b);)";
    r.pack = [](FieldReader& in, glm::uvec4* rows) {
        LightSample chosen;
        Reservoir reservoir;
        chosen.light = in.take();
        chosen.uv = in.take2();
        reservoir.contribution_weight = in.take1();
        reservoir.confidence = in.take1();
        reservoir.target = in.take1();
        reservoir.visibility = in.take1();
        reservoir.age = in.take1();
        pack_reservoir(reservoir, pack_light_sample(chosen), rows[0], rows[1]);
    };
    r.unpack = [](const glm::uvec4* rows, FieldWriter& out) {
        const Reservoir reservoir = unpack_reservoir(rows[0], rows[1]);
        const LightSample chosen = unpack_light_sample(glm::uvec3(rows[0]));
        out.put(chosen.light);
        out.put(chosen.uv);
        out.put(reservoir.contribution_weight);
        out.put(reservoir.confidence);
        out.put(reservoir.target);
        out.put(reservoir.visibility);
        out.put(reservoir.age);
    };
    return r;
}

inline Record ray_record() {
    Record r{"ray", RAY_ROWS, "fffffffu", {}, {}, {}, {}};
    r.glsl_unpack = R"(
        RayRecord r = unpack_ray(row(0u), row(1u));
        put(r.origin); put(r.max_t); put(r.direction); put(r.pixel);)";
    r.glsl_pack = R"(
        RayRecord r; r.origin = take3(); r.max_t = take1(); r.direction = take3(); r.pixel = take();
        uvec4 a, b; pack_ray(r, a, b); store(0u, a); store(1u, b);)";
    r.pack = [](FieldReader& in, glm::uvec4* rows) {
        RayRecord ray;
        ray.origin = in.take3();
        ray.max_t = in.take1();
        ray.direction = in.take3();
        ray.pixel = in.take();
        pack_ray(ray, rows[0], rows[1]);
    };
    r.unpack = [](const glm::uvec4* rows, FieldWriter& out) {
        const RayRecord ray = unpack_ray(rows[0], rows[1]);
        out.put(ray.origin);
        out.put(ray.max_t);
        out.put(ray.direction);
        out.put(ray.pixel);
    };
    return r;
}

inline Record hit_record() {
    Record r{"hit", HIT_ROWS, "uuffffff", {}, {}, {}, {}};
    r.glsl_unpack = R"(
        HitRecord h = unpack_hit(row(0u), row(1u));
        put(h.instance); put(h.primitive); put(h.barycentrics); put(h.direction); put(h.distance);)";
    r.glsl_pack = R"(
        HitRecord h; h.instance = take(); h.primitive = take(); h.barycentrics = take2(); h.direction = take3();
        h.distance = take1();
        uvec4 a, b; pack_hit(h, a, b); store(0u, a); store(1u, b);)";
    r.pack = [](FieldReader& in, glm::uvec4* rows) {
        HitRecord hit;
        hit.instance = in.take();
        hit.primitive = in.take();
        hit.barycentrics = in.take2();
        hit.direction = in.take3();
        hit.distance = in.take1();
        pack_hit(hit, rows[0], rows[1]);
    };
    r.unpack = [](const glm::uvec4* rows, FieldWriter& out) {
        const HitRecord hit = unpack_hit(rows[0], rows[1]);
        out.put(hit.instance);
        out.put(hit.primitive);
        out.put(hit.barycentrics);
        out.put(hit.direction);
        out.put(hit.distance);
    };
    return r;
}

inline Record alias_record() {
    Record r{"alias_bucket", 1, "fuff", {}, {}, {}, {}};
    r.glsl_unpack = R"(
        AliasBucket b = unpack_alias_bucket(row(0u));
        put(b.threshold); put(b.alias); put(b.pmf_own); put(b.pmf_alias);)";
    r.glsl_pack = R"(
        AliasBucket b; b.threshold = take1(); b.alias = take(); b.pmf_own = take1(); b.pmf_alias = take1();
        store(0u, pack_alias_bucket(b));)";
    r.pack = [](FieldReader& in, glm::uvec4* rows) {
        AliasBucket b;
        b.threshold = in.take1();
        b.alias = in.take();
        b.pmf_own = in.take1();
        b.pmf_alias = in.take1();
        rows[0] = pack_alias_bucket(b);
    };
    r.unpack = [](const glm::uvec4* rows, FieldWriter& out) {
        const AliasBucket b = unpack_alias_bucket(rows[0]);
        out.put(b.threshold), out.put(b.alias), out.put(b.pmf_own), out.put(b.pmf_alias);
    };
    return r;
}

}  // namespace tarn::test
