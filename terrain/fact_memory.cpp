#include "terrain/fact_memory.h"

#include <sys/mman.h>

#include <cstring>

#include "lod/base/check.h"

namespace terrain {

FactMemory::FactMemory(size_t count) {
    if (count == 0) return;
    void* memory = mmap(nullptr, count * sizeof(DiamondSource), PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    CHECK(memory != MAP_FAILED);
    // The front reads it all over the place: fewer translations to look up. Where that is unknown, nothing is lost.
    static_cast<void>(madvise(memory, count * sizeof(DiamondSource), MADV_HUGEPAGE));
    facts_ = static_cast<DiamondSource*>(memory);
    count_ = count;
}

FactMemory::FactMemory(const FactMemory& other) : FactMemory(other.count_) {
    if (count_ > 0) std::memcpy(facts_, other.facts_, count_ * sizeof(DiamondSource));
}

FactMemory::~FactMemory() {
    if (facts_ != nullptr) munmap(facts_, count_ * sizeof(DiamondSource));
}

FactMemory FactMemory::of_file(int file, uint64_t offset_bytes, size_t count, bool is_writable) {
    FactMemory memory;
    const int access = is_writable ? PROT_READ | PROT_WRITE : PROT_READ;
    void* mapped = mmap(nullptr, count * sizeof(DiamondSource), access, MAP_SHARED, file,
                        static_cast<off_t>(offset_bytes));
    if (mapped == MAP_FAILED) return memory;
    memory.facts_ = static_cast<DiamondSource*>(mapped);
    memory.count_ = count;
    return memory;
}

}  // namespace terrain
