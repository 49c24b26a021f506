// What a mistyped name was meant to be.
#pragma once

#include <span>
#include <string>

namespace tarn {

// "; did you mean 'render'?" with the names that differ from `name` by few letters, the nearest first; empty
// where there is none. A letter too many, one too few, another one, or two that changed places count as one
// (optimal string alignment); a third of the letters may differ.
std::string suggest_names(const std::string& name, std::span<const std::string> names);

}  // namespace tarn
