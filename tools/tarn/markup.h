// Text inside of XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace tarn {

// `text` for the content of an element or a quoted attribute, of XML 1.0 and of HTML alike: & < > " ' and
// white space other than blanks become references. Bytes that are not UTF-8, and characters that XML does not
// allow (most control characters), become U+FFFD.
std::string escape_markup(std::string_view text);

// A relative path as part of a URL: each byte but letters, digits, - . _ ~ and / becomes %XX.
std::string escape_url(std::string_view path);

}  // namespace tarn
