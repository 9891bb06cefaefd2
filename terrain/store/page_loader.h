// PageLoader: keeps the pages of a store that matter in a table's slots, read by a thread of its own.
//
//     frame's thread   exchange(): eyes out; pages that have come in, pages that must go out; never blocks
//     worker           judges (page_judge.h), decides (page_plan.h), reads and checks (store_file.h)
//
// A slot has one owner at a time. The worker writes into a free one, hands it over, and touches it again only after
// the frame's thread has made its page absent: nothing that a frame reads ever changes under it. What is absent is
// drawn coarser, never missing.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "lod/view.h"
#include "terrain/diamond_table.h"
#include "terrain/store/eye_tracker.h"
#include "terrain/store/page_judge.h"
#include "terrain/store/page_plan.h"
#include "terrain/store/store_file.h"

namespace terrain {

struct PageLoaderOptions {
    uint64_t memory_bytes = 512u << 20;  ///< hard limit: slots and everything kept per page
    double want_px = 0.5;  ///< pages worth at least this are wanted; below the tolerance, to be there early
    /// exchange() returns only when everything wanted is here: for runs that must repeat exactly.
    bool waits = false;
    /// Told once, from the worker's thread, when a page cannot be read.
    std::function<void(const std::string&)> on_trouble{};
};

class PageLoader;

/// A table with the pages that always stay, and what brings the others. The table may be moved, not copied; it must
/// live as long as the loader.
struct PagedTable {
    DiamondTable table;
    std::unique_ptr<PageLoader> loader;
};

/// Reads the pages that always stay and starts the worker.
/// Fails when one of those cannot be read, or when memory_bytes is too little for a start.
lod::Result<PagedTable> open_paged_table(StoreFile store, const PageLoaderOptions& options);

class PageLoader {
  public:
    PageLoader(const PageLoader&) = delete;
    PageLoader& operator=(const PageLoader&) = delete;
    ~PageLoader();

    /// To be called at the start of each frame. Tells the worker where the eyes are, makes the pages that have come
    /// present in `table` and those that go absent. Never waits for the worker (unless options.waits), never reads
    /// the file, allocates nothing once warm. Cost: O(pages that changed).
    /// @param views   one per channel
    /// @param time_s  simulation time; may stand still or jump
    /// @param table   open_paged_table's
    /// @returns how many pages have come
    size_t exchange(std::span<const lod::View> views, double time_s, DiamondTable& table);

    /// Blocks until the worker has done all it can for the last exchange; what it did comes with the next one.
    void wait_until_settled();

    PageTally tally() const;
    const StoreFile& store() const { return store_; }
    /// Pages that always stay.
    size_t pinned_count() const { return plan_.pinned_count(); }
    /// Bytes of slots and bookkeeping; never above options.memory_bytes.
    uint64_t memory_bytes() const { return memory_bytes_; }

  private:
    friend lod::Result<PagedTable> open_paged_table(StoreFile store, const PageLoaderOptions& options);
    PageLoader(StoreFile store, const PageLoaderOptions& options, size_t slot_count);

    struct Trade {
        size_t came = 0, left = 0;
    };
    Trade trade(DiamondTable& table);
    lod::Result<lod::Ok> read_pinned(DiamondTable& table);
    void run();
    bool take_mail(bool may_wait);
    bool load_one();
    void ask_for_room();
    bool is_look_due() const;

    StoreFile store_;
    PageLoaderOptions options_;
    uint64_t memory_bytes_ = 0;
    EyeTracker tracker_;  // the frame's

    // The worker's.
    PageJudge judge_;
    PagePlan plan_;
    DiamondSource* slots_ = nullptr;  // the table's
    std::vector<MovingEye> eyes_, looked_eyes_;
    double age_s_ = 0.0, looked_s_ = -1e9;
    std::vector<size_t> gone_, chosen_;
    bool has_complained_ = false;

    // Between the two, under the mutex, which is held for copies of a few words only.
    struct Mail {
        std::vector<MovingEye> eyes;
        double age_s = 0.0;
        bool has_eyes = false, is_stopping = false, is_idle = false;
        std::vector<PagePlan::Placement> came;
        std::vector<size_t> leaving, left;
        PageTally tally;
    };
    mutable std::mutex mutex_;
    std::condition_variable wake_, settled_;
    Mail mail_;
    std::thread worker_;
};

}  // namespace terrain
