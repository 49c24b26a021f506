// Memory for the values of a frame: it goes back to its pool with the last reference, and the next value of
// its kind gets it again.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tarn {

template <class T>
class Pool {
  public:
    // A T of the kind `key`: one that nobody refers to any more, else a new one by `make()`, which returns a
    // T.
    template <class Make>
    std::shared_ptr<T> take(const std::string& key, const Make& make) {
        std::vector<std::unique_ptr<T>>& unused = (*unused_)[key];
        std::unique_ptr<T> item;
        if (unused.empty()) {
            item.reset(new T(make()));
        } else {
            item = std::move(unused.back());
            unused.pop_back();
        }
        const auto give_back = [pool = std::weak_ptr(unused_), key](T* given) {
            std::unique_ptr<T> owned(given);
            if (const auto alive = pool.lock()) (*alive)[key].push_back(std::move(owned));
        };
        return std::shared_ptr<T>(item.release(), give_back);
    }

  private:
    using Unused = std::map<std::string, std::vector<std::unique_ptr<T>>>;
    std::shared_ptr<Unused> unused_ = std::make_shared<Unused>();
};

}  // namespace tarn
