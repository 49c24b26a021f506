// Typed reading of glTF accessors: strided, sparse, normalized, quantized.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_document.h"

namespace tarn {

// Elements of one accessor.
std::size_t accessor_count(const GltfDocument& document, int accessor);

// False where the accessor reads from a buffer that came without bytes (glTF leaves those to extensions).
bool has_data(const GltfDocument& document, int accessor);

// Components per element: 1 to 4, 9 or 16.
std::size_t accessor_components(const GltfDocument& document, int accessor);

// All components, [element][component]; integers are converted, and mapped to 0..1 or -1..1 where the
// accessor is normalized. `out` holds count * components. Throws Error for NaN and Inf, and for a buffer that
// has no bytes.
void read_floats(const GltfDocument& document, int accessor, std::span<float> out);

// The same for unsigned integers. Throws Error for an accessor of another component type.
void read_unsigned(const GltfDocument& document, int accessor, std::span<std::uint32_t> out);

// Throws Error unless the accessor has `components` components per element.
void expect_components(const GltfDocument& document, int accessor, std::size_t components,
                       const std::string& what);

// A whole accessor as scalars, vectors or matrices of float; `what` names its use in errors.
template <class Element>
std::vector<Element> read_elements(const GltfDocument& document, int accessor, const std::string& what) {
    static_assert(sizeof(Element) % sizeof(float) == 0);
    constexpr std::size_t COMPONENTS = sizeof(Element) / sizeof(float);
    expect_components(document, accessor, COMPONENTS, what);
    std::vector<Element> elements(accessor_count(document, accessor));
    read_floats(document, accessor,
                {reinterpret_cast<float*>(elements.data()), elements.size() * COMPONENTS});
    return elements;
}

}  // namespace tarn
