// What the command line's values are made of.
#pragma once

#include <string>
#include <vector>

namespace tarn {

// The parts of `text` between separators; one more than there are separators, and any may be empty.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace tarn
