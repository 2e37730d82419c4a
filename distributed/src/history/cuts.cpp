#include "history/cuts.hpp"

namespace octetra::distributed {

void CutRuns::append(Cut cut, std::uint64_t count) {
    if (cut != cut_) {
        write_run();
        cut_ = cut;
    }
    count_ += count;
}

void CutRuns::write_run() {
    if (count_ == 1) bytes_.push_back(cut_);
    if (count_ > 1) {
        bytes_.push_back(static_cast<std::uint8_t>(cut_ | 128U));
        std::uint64_t rest = count_ - 2;
        for (; rest >= 128; rest >>= 7U) {
            bytes_.push_back(static_cast<std::uint8_t>(128U | (rest & 127U)));
        }
        bytes_.push_back(static_cast<std::uint8_t>(rest));
    }
    count_ = 0;
}

}  // namespace octetra::distributed
