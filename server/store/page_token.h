// Where the next page of a list begins, in a word that clients carry from one call to the next.
#pragma once

#include <string>

#include "server/store/records.h"

namespace kcs::store {

// The last plan of a page.
struct PageEnd {
  Time create_time{};
  std::string name;
};

// A word of letters, digits and slashes that says where a page ended and, in a digest, whose list it was a page of.
std::string page_token(const PageEnd& end, const Whose& whose, const Filter& filter);

// Throws InvalidPageToken unless page_token() made `token` for the same list and filter.
PageEnd parse_page_token(const std::string& token, const Whose& whose, const Filter& filter);

}  // namespace kcs::store
