// SPDX-License-Identifier: MIT
#include "live/foxglove_queue.hpp"

#include <algorithm>

namespace dynamic_filter::live {
namespace {

auto is_of(std::uint32_t subscription) {
    return [subscription](const Outgoing& m) { return m.subscription == subscription; };
}

}  // namespace

bool FoxgloveQueue::put_message(Outgoing message, std::size_t depth) {
    const std::size_t size = message.body->size();
    const auto own = is_of(message.subscription);
    auto waiting = static_cast<std::size_t>(std::count_if(messages_.begin(), messages_.end(), own));
    const std::size_t room = std::max<std::size_t>(depth, 1);
    while (waiting > 0 && (waiting >= room || bytes_ + size > most_bytes_)) {
        drop_oldest(message.subscription);
        --waiting;
    }
    if (!messages_.empty() && bytes_ + size > most_bytes_) return false;
    bytes_ += size;
    messages_.push_back(std::move(message));
    return true;
}

void FoxgloveQueue::drop_oldest(std::uint32_t subscription) {
    const auto oldest = std::find_if(messages_.begin(), messages_.end(), is_of(subscription));
    bytes_ -= oldest->body->size();
    messages_.erase(oldest);
}

void FoxgloveQueue::forget(std::uint32_t subscription) {
    std::erase_if(messages_, is_of(subscription));
    bytes_ = 0;
    for (const Outgoing& message : messages_) bytes_ += message.body->size();
}

void FoxgloveQueue::clear() {
    texts_.clear();
    messages_.clear();
    bytes_ = 0;
}

std::optional<Outgoing> FoxgloveQueue::pop() {
    if (!texts_.empty()) {
        Outgoing next{.head = std::move(texts_.front()), .body = nullptr, .subscription = 0};
        texts_.pop_front();
        return next;
    }
    if (messages_.empty()) return {};
    Outgoing next = std::move(messages_.front());
    messages_.pop_front();
    bytes_ -= next.body->size();
    return next;
}

}  // namespace dynamic_filter::live
