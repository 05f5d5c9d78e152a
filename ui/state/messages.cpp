// SPDX-License-Identifier: Apache-2.0
#include "ui/state/messages.h"

#include <algorithm>

namespace nephroid::ui {

void Messages::error(const std::exception& error)
{
  const auto* known = dynamic_cast<const Error*>(&error);
  say(true, error.what(), known ? known->kind() : ErrorKind::failed);
}

void Messages::say(bool error, std::string line, ErrorKind kind)
{
  if (std::any_of(messages_.begin(), messages_.end(), [&](const Message& m) { return m.line == line && m.error == error; })) return;
  messages_.push_back({++newest_, error, std::move(line), Clock::now(), kind});
}

void Messages::dismiss(std::uint64_t id)
{
  std::erase_if(messages_, [&](const Message& m) { return m.id == id; });
}

void Messages::dismiss_errors_until(std::uint64_t id)
{
  std::erase_if(messages_, [&](const Message& m) { return m.error && m.id <= id; });
}

void Messages::expire(Clock::time_point now)
{
  constexpr std::chrono::seconds lifetime{6};
  std::erase_if(messages_, [&](const Message& m) { return !m.error && now - m.since > lifetime; });
}

} // namespace nephroid::ui
