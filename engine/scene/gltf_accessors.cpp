// Reads accessors whose ranges check_gltf_document() has proved (glTF 2.0 specification, section 3.6.2).
#include "scene/gltf_accessors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "scene/gltf_checks.h"

namespace tarn {
namespace {

const tinygltf::Accessor& accessor_at(const GltfDocument& document, int accessor) {
    return document.model.accessors[std::size_t(accessor)];
}

ElementLayout layout_at(const GltfDocument& document, int accessor) {
    return layout_of(accessor_at(document, accessor), fmt::format("accessors[{}]", accessor));
}

// The first byte of `offset` in a buffer view.
const std::uint8_t* view_bytes(const GltfDocument& document, int view_index, std::size_t offset) {
    const tinygltf::BufferView& view = document.model.bufferViews[std::size_t(view_index)];
    const tinygltf::Buffer& buffer = document.model.buffers[std::size_t(view.buffer)];
    if (buffer.data.empty()) throw Error("buffers[{}] has no data", view.buffer);
    return buffer.data.data() + view.byteOffset + offset;
}

template <class Component>
Component load(const std::uint8_t* bytes) {
    Component value;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
}

template <class Component>
float normalize(Component value) {
    const float limit = float(std::numeric_limits<Component>::max());
    return std::max(float(value) / limit, -1.0f);
}

float load_float(const std::uint8_t* bytes, int component_type, bool normalized) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const auto value = load<std::int8_t>(bytes);
            return normalized ? normalize(value) : float(value);
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
            const auto value = load<std::uint8_t>(bytes);
            return normalized ? normalize(value) : float(value);
        }
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const auto value = load<std::int16_t>(bytes);
            return normalized ? normalize(value) : float(value);
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
            const auto value = load<std::uint16_t>(bytes);
            return normalized ? normalize(value) : float(value);
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
            const auto value = load<std::uint32_t>(bytes);
            return normalized ? float(double(value) / 4294967295.0) : float(value);
        }
        default:
            return load<float>(bytes);
    }
}

std::uint32_t load_unsigned(const std::uint8_t* bytes, int component_type) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

bool is_unsigned(int component_type) {
    return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// Byte offset of component `c` within an element: columns of small matrices start at multiples of 4 bytes.
std::size_t component_offset(const ElementLayout& layout, std::size_t c) {
    if (layout.element_bytes == layout.component_bytes * layout.component_count)
        return c * layout.component_bytes;
    const std::size_t rows = layout.component_count == 9 ? 3 : 2;
    const std::size_t column_bytes = layout.element_bytes / rows;
    return c / rows * column_bytes + c % rows * layout.component_bytes;
}

// Calls convert(bytes of a component, index in the output) for `count` elements; element k goes to place(k).
template <class Place, class Convert>
void for_each_component(const std::uint8_t* bytes, std::size_t count, std::size_t stride,
                        const ElementLayout& layout, const Place& place, const Convert& convert) {
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t first = place(k) * layout.component_count;
        for (std::size_t c = 0; c < layout.component_count; ++c) {
            convert(bytes + k * stride + component_offset(layout, c), first + c);
        }
    }
}

template <class Convert>
void read_dense(const GltfDocument& document, const tinygltf::Accessor& accessor, const ElementLayout& layout,
                const Convert& convert) {
    if (accessor.bufferView == document.no_data_view || accessor.count == 0) return;
    const std::size_t view_stride = document.model.bufferViews[std::size_t(accessor.bufferView)].byteStride;
    const std::size_t stride = view_stride != 0 ? view_stride : layout.element_bytes;
    const std::uint8_t* bytes = view_bytes(document, accessor.bufferView, accessor.byteOffset);
    for_each_component(
        bytes, accessor.count, stride, layout, [](std::size_t k) { return k; }, convert);
}

template <class Convert>
void read_sparse(const GltfDocument& document, int index, const ElementLayout& layout,
                 const Convert& convert) {
    const tinygltf::Accessor& accessor = accessor_at(document, index);
    const auto& sparse = accessor.sparse;
    if (!sparse.isSparse || sparse.count == 0) return;
    if (!is_unsigned(sparse.indices.componentType)) {
        throw Error("accessors[{}].sparse.indices.componentType is {}, an unsigned type is expected", index,
                    sparse.indices.componentType);
    }
    const std::size_t index_bytes =
        std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(sparse.indices.componentType)));
    const std::uint8_t* indices =
        view_bytes(document, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset));
    const std::uint8_t* values =
        view_bytes(document, sparse.values.bufferView, std::size_t(sparse.values.byteOffset));
    const auto place = [&](std::size_t k) {
        const std::size_t target = load_unsigned(indices + k * index_bytes, sparse.indices.componentType);
        if (target >= accessor.count) {
            throw Error("accessors[{}].sparse replaces element {}, the accessor has {}", index, target,
                        accessor.count);
        }
        return target;
    };
    for_each_component(values, std::size_t(sparse.count), layout.element_bytes, layout, place, convert);
}

void check_finite(std::span<const float> values, std::size_t components, int accessor) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            throw Error("accessors[{}] element {} component {} is {}, a finite number is expected", accessor,
                        i / components, i % components, values[i]);
        }
    }
}

}  // namespace

std::size_t accessor_count(const GltfDocument& document, int accessor) {
    return accessor_at(document, accessor).count;
}

bool has_data(const GltfDocument& document, int accessor) {
    const tinygltf::Accessor& source = accessor_at(document, accessor);
    const auto view_has_data = [&](int view) {
        const int buffer = document.model.bufferViews[std::size_t(view)].buffer;
        return view == document.no_data_view || !document.model.buffers[std::size_t(buffer)].data.empty();
    };
    if (!view_has_data(source.bufferView)) return false;
    return !source.sparse.isSparse || (view_has_data(source.sparse.indices.bufferView) &&
                                       view_has_data(source.sparse.values.bufferView));
}

std::size_t accessor_components(const GltfDocument& document, int accessor) {
    return layout_at(document, accessor).component_count;
}

void read_floats(const GltfDocument& document, int accessor, std::span<float> out) {
    const tinygltf::Accessor& source = accessor_at(document, accessor);
    const ElementLayout layout = layout_at(document, accessor);
    TARN_ASSERT(out.size() == source.count * layout.component_count, "{} floats for accessors[{}]",
                out.size(), accessor);
    std::fill(out.begin(), out.end(), 0.0f);
    const int type = source.componentType;
    const bool normalized = source.normalized;
    const auto convert = [&](const std::uint8_t* bytes, std::size_t i) {
        out[i] = load_float(bytes, type, normalized);
    };
    read_dense(document, source, layout, convert);
    read_sparse(document, accessor, layout, convert);
    check_finite(out, layout.component_count, accessor);
}

void read_unsigned(const GltfDocument& document, int accessor, std::span<std::uint32_t> out) {
    const tinygltf::Accessor& source = accessor_at(document, accessor);
    const ElementLayout layout = layout_at(document, accessor);
    if (!is_unsigned(source.componentType)) {
        throw Error("accessors[{}].componentType is {}, an unsigned type is expected", accessor,
                    source.componentType);
    }
    TARN_ASSERT(out.size() == source.count * layout.component_count, "{} integers for accessors[{}]",
                out.size(), accessor);
    std::fill(out.begin(), out.end(), 0u);
    const int type = source.componentType;
    const auto convert = [&](const std::uint8_t* bytes, std::size_t i) {
        out[i] = load_unsigned(bytes, type);
    };
    read_dense(document, source, layout, convert);
    read_sparse(document, accessor, layout, convert);
}

void expect_components(const GltfDocument& document, int accessor, std::size_t components,
                       const std::string& what) {
    const std::size_t found = accessor_components(document, accessor);
    if (found != components) {
        throw Error("{} (accessors[{}]) has {} components, {} are expected", what, accessor, found,
                    components);
    }
}

}  // namespace tarn
