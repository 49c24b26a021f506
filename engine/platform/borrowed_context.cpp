// A context that somebody else made: current already, and left as it is.
#include "core/error.h"
#include "platform/backends.h"

namespace tarn {
namespace {

class BorrowedContext final : public Context {
  public:
    explicit BorrowedContext(GlFunction (*get_proc_address)(const char*))
        : Context(ContextKind::BORROWED, get_proc_address) {
        try {
            start(false);
        } catch (...) {
            stop();
            throw;
        }
    }

    ~BorrowedContext() override { stop(); }

  private:
    void bind() override {}
    void unbind() override {}
};

}  // namespace

std::unique_ptr<Context> create_borrowed_context(void (*(*get_proc_address)(const char*))()) {
    if (get_proc_address == nullptr) throw Error("a borrowed context needs a loader of GL functions");
    return std::make_unique<BorrowedContext>(get_proc_address);
}

}  // namespace tarn
