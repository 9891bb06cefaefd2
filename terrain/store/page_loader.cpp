#include "terrain/store/page_loader.h"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>

namespace terrain {
namespace {

constexpr size_t kLeastSlots = 24;
constexpr double kLookAgain_s = 0.25;  // though nothing moved: what lingers grows older
constexpr double kTurned = 0.05;       // radians, about
constexpr double kMovedShare = 0.125;  // of half a finest page

/// What is kept per entry of the store, in memory or not, beside its directory and the table's map.
constexpr uint64_t kBytesPerEntry =
    sizeof(PageSummary) + PageJudge::bytes_per_page() + PagePlan::bytes_per_page();
/// And per slot: its facts, and its places in the lists.
constexpr uint64_t kBytesPerSlot = kPageBytes + 6 * sizeof(size_t);

bool is_alike(const MovingEye& a, const MovingEye& b, double moved_m) {
    const glm::dmat3 turn = a.view.eye_from_world - b.view.eye_from_world;
    double turned = 0.0;
    for (int i = 0; i < 3; ++i)
        turned = std::max(turned, glm::length(turn[i]));
    const double speed = std::max(glm::length(a.velocity_mps), glm::length(b.velocity_mps));
    return a.view.fov_y_rad == b.view.fov_y_rad && a.view.width_px == b.view.width_px &&
           a.view.height_px == b.view.height_px && turned < kTurned &&
           glm::distance(a.view.eye_world, b.view.eye_world) < moved_m &&
           glm::distance(a.velocity_mps, b.velocity_mps) <= 0.1 * speed;
}

/// Of a store that is open, whatever its slots.
uint64_t overhead_bytes(const StoreFile& store) {
    return store.directory().count() * kBytesPerEntry + store.directory().memory_bytes() +
           store.make_table().slot_of_page.memory_bytes();
}

/// The calling thread yields to the frame's: waking it never takes a processor from who woke it. Where the system
/// knows no such thing nothing is lost but that.
void step_back() {
    const sched_param none{};
    static_cast<void>(pthread_setschedparam(pthread_self(), SCHED_BATCH, &none));
    static_cast<void>(setpriority(PRIO_PROCESS, 0, 5));  // of this thread alone, on Linux
}

}  // namespace

lod::Result<PagedTable> open_paged_table(StoreFile store, const PageLoaderOptions& options) {
    const size_t count = store.directory().count();
    const uint64_t overhead = overhead_bytes(store);
    const size_t least_slots = std::min(kLeastSlots + 2 * store.directory().level_count(), count);
    const uint64_t least = overhead + least_slots * kBytesPerSlot;
    if (options.memory_bytes < least) {
        return lod::Error{"terrain store '" + store.path() + "': a limit of " +
                          std::to_string(options.memory_bytes) + " bytes is too little, expected at least " +
                          std::to_string(least)};
    }
    const size_t slot_count = std::min<uint64_t>(count, (options.memory_bytes - overhead) / kBytesPerSlot);
    PagedTable paged{store.make_table(), nullptr};
    paged.table.slots = FactMemory(slot_count * kPageEntries);
    paged.loader.reset(new PageLoader(std::move(store), options, slot_count));
    if (auto read = paged.loader->read_pinned(paged.table); !read) return read.error();
    paged.loader->worker_ = std::thread([loader = paged.loader.get()] { loader->run(); });
    return paged;
}

PageLoader::PageLoader(StoreFile store, const PageLoaderOptions& options, size_t slot_count)
    : store_(std::move(store)),
      options_(options),
      memory_bytes_(overhead_bytes(store_) + slot_count * kBytesPerSlot),
      judge_(store_),
      plan_(store_.directory(), slot_count, static_cast<float>(options.want_px)) {
    mail_.came.reserve(slot_count);
    mail_.leaving.reserve(slot_count);
    mail_.left.reserve(slot_count);
    gone_.reserve(slot_count);
}

PageLoader::~PageLoader() {
    if (!worker_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        mail_.is_stopping = true;
    }
    wake_.notify_one();
    worker_.join();
}

lod::Result<lod::Ok> PageLoader::read_pinned(DiamondTable& table) {
    slots_ = table.slots.data();
    for (size_t page = 0; page < plan_.pinned_count(); ++page) {
        auto read = store_.read_page(page, {slots_ + page * kPageEntries, kPageEntries});
        if (!read) return read.error();
        if (!store_.directory().is_level(page))
            table.slot_of_page.set(store_.directory().number(page), static_cast<uint32_t>(page));
    }
    return lod::Ok{};
}

size_t PageLoader::exchange(std::span<const lod::View> views, double time_s, DiamondTable& table) {
    CHECK(table.slots.data() == slots_);
    tracker_.advance(views, time_s);
    std::unique_lock lock(mutex_, std::defer_lock);
    if (options_.waits) lock.lock();
    if (!lock.owns_lock() && !lock.try_lock()) return 0;  // busy for a moment; the next frame will do
    mail_.eyes = tracker_.eyes();
    mail_.age_s = tracker_.age_s();
    mail_.has_eyes = true;
    Trade now = trade(table);
    lock.unlock();
    wake_.notify_one();
    size_t came = now.came;
    while (options_.waits) {
        wait_until_settled();
        lock.lock();
        now = trade(table);
        lock.unlock();
        wake_.notify_one();
        if (now.came + now.left == 0) break;
        came += now.came;
    }
    return came;
}

/// Under the mutex.
PageLoader::Trade PageLoader::trade(DiamondTable& table) {
    const Trade trade{mail_.came.size(), mail_.leaving.size()};
    for (const PagePlan::Placement& placement : mail_.came)
        table.slot_of_page.set(store_.directory().number(placement.page), placement.slot);
    for (size_t page : mail_.leaving)
        table.slot_of_page.set(store_.directory().number(page), DiamondTable::kAbsent);
    mail_.left.insert(mail_.left.end(), mail_.leaving.begin(), mail_.leaving.end());
    mail_.came.clear();
    mail_.leaving.clear();
    return trade;
}

void PageLoader::wait_until_settled() {
    std::unique_lock lock(mutex_);
    settled_.wait(lock, [&] { return mail_.is_idle && !mail_.has_eyes && mail_.left.empty(); });
}

PageTally PageLoader::tally() const {
    const std::lock_guard lock(mutex_);
    return mail_.tally;
}

void PageLoader::run() {
    if (!options_.waits) step_back();
    bool is_busy = false;
    while (take_mail(!is_busy)) {
        for (size_t page : gone_)
            plan_.has_left(page);
        gone_.clear();
        if (is_look_due()) {
            judge_.look(eyes_);
            plan_.look(judge_, age_s_);
            looked_eyes_ = eyes_;
            looked_s_ = age_s_;
        }
        is_busy = load_one();
        if (!is_busy) ask_for_room();
    }
}

/// The frame's news. @param may_wait  nothing is left to do without any. @returns false when all is over
bool PageLoader::take_mail(bool may_wait) {
    std::unique_lock lock(mutex_);
    const auto has_news = [&] { return mail_.is_stopping || mail_.has_eyes || !mail_.left.empty(); };
    if (may_wait && !has_news()) {
        mail_.is_idle = true;
        settled_.notify_all();
        wake_.wait(lock, has_news);
        mail_.is_idle = false;
    }
    if (mail_.has_eyes) {
        eyes_ = mail_.eyes;
        age_s_ = mail_.age_s;
        mail_.has_eyes = false;
    }
    std::swap(gone_, mail_.left);
    return !mail_.is_stopping;
}

bool PageLoader::is_look_due() const {
    if (eyes_.size() != looked_eyes_.size() || age_s_ >= looked_s_ + kLookAgain_s) return !eyes_.empty();
    for (size_t i = 0; i < eyes_.size(); ++i) {
        if (!is_alike(eyes_[i], looked_eyes_[i], kMovedShare * judge_.finest_reach_m())) return true;
    }
    return false;
}

/// Whether there was something to load.
bool PageLoader::load_one() {
    const auto placement = plan_.next();
    if (!placement) return false;
    const auto read =
        store_.read_page(placement->page, {slots_ + placement->slot * kPageEntries, kPageEntries});
    if (!read) {
        plan_.give_up(placement->page);
        if (!has_complained_ && options_.on_trouble)
            options_.on_trouble(read.message() + "; drawn coarser there");
        has_complained_ = true;
        return true;
    }
    const std::lock_guard lock(mutex_);
    mail_.came.push_back(*placement);
    return true;
}

void PageLoader::ask_for_room() {
    chosen_.clear();
    plan_.choose_leavers(chosen_);
    const PageTally tally = plan_.tally();
    const std::lock_guard lock(mutex_);
    mail_.leaving.insert(mail_.leaving.end(), chosen_.begin(), chosen_.end());
    mail_.tally = tally;
}

}  // namespace terrain
