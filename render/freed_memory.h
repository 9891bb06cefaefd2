// What the process does with memory that a frame has given back.
#pragma once

namespace render {

/// From now on the allocator keeps freed memory instead of handing it back to the system, up to 1 GiB. A software
/// rasteriser allocates tens of MB for a frame and frees them at its end; handed back, every page of it has to be cleared
/// and mapped anew in the next frame, which can take longer than drawing (docs/benchmarks.md). For the whole process;
/// does nothing where the C library has no such setting.
void keep_freed_memory();

}  // namespace render
