// Files that appear complete or not at all: written beside their place under another name, then renamed.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "lod/base/result.h"

namespace sim {

/// Lets `write` make the file at a temporary path in the same folder, then renames it to `path`.
/// @param write  returns whether the file was written whole
/// Fails naming `path`; nothing is left behind then.
lod::Result<lod::Ok> write_whole(const std::string& path,
                                 const std::function<bool(const std::string&)>& write);

/// The same for bytes at hand.
lod::Result<lod::Ok> write_whole(const std::string& path, std::string_view bytes);

/// Makes a folder and those above it. Fails naming it.
lod::Result<lod::Ok> make_folder(const std::string& path);

/// Fails when a file could not be put at `path`, before long work is spent on its contents.
lod::Result<lod::Ok> check_writable(const std::string& path);

}  // namespace sim
