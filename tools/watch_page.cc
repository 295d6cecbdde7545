#include "tools/watch_page.h"

#include <httplib.h>

#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "model/text/input_error.h"
#include "tools/report/assets.h"

namespace armcal {
namespace {

constexpr char kHost[] = "127.0.0.1";
constexpr size_t kShownEvents = 200;

// A page of another name that leads here (DNS rebinding) is not answered.
bool IsOurs(const httplib::Request& request, int port) {
  const std::string host = request.get_header_value("Host");
  const std::string end = ":" + std::to_string(port);
  return host == kHost + end || host == "localhost" + end;
}

nlohmann::json NumberOrNull(const Eigen::VectorXd& values, int j) {
  if (j < values.size()) return values[j];
  return nullptr;
}

}  // namespace

struct WatchPage::Impl {
  explicit Impl(const Robot& robot) : robot(robot) {
    json = {{"robot", robot.name}, {"time", nullptr}};
  }

  void Serve(const char* path, std::string_view text, const char* type) {
    server.Get(path, [this, text, type](const httplib::Request& request,
                                        httplib::Response& response) {
      if (!IsOurs(request, port)) {
        response.status = 403;
        return;
      }
      response.set_header("Content-Security-Policy",
                          "default-src 'self'; img-src data:");
      response.set_content(text.data(), text.size(), type);
    });
  }

  void ServeState() {
    server.Get("/state.json", [this](const httplib::Request& request,
                                     httplib::Response& response) {
      if (!IsOurs(request, port)) {
        response.status = 403;
        return;
      }
      const std::lock_guard<std::mutex> lock(mutex);
      nlohmann::json state = json;
      state["events"] = events;
      response.set_header("Cache-Control", "no-store");
      response.set_content(
          state.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
          "application/json");
    });
  }

  Robot robot;
  httplib::Server server;
  int port = 0;
  std::thread thread;
  std::mutex mutex;  // of what follows
  nlohmann::json json;
  std::deque<nlohmann::json> events;
};

WatchPage::WatchPage(const Robot& robot, int port)
    : impl_(std::make_unique<Impl>(robot)) {
  Impl& i = *impl_;
  i.server.new_task_queue = [] { return new httplib::ThreadPool(2); };
  i.Serve("/", WatchHtml(), "text/html; charset=utf-8");
  i.Serve("/watch.js", WatchScript(), "text/javascript; charset=utf-8");
  i.Serve("/watch.css", WatchStyle(), "text/css; charset=utf-8");
  i.ServeState();
  if (port == 0) {
    i.port = i.server.bind_to_any_port(kHost);
  } else if (i.server.bind_to_port(kHost, port)) {
    i.port = port;
  }
  if (i.port <= 0) {
    throw InputError("port " + std::to_string(port), "", "",
                     "cannot be had: another program may listen there");
  }
  i.thread = std::thread([&i] { i.server.listen_after_bind(); });
}

WatchPage::~WatchPage() {
  // stop() before the server runs would be forgotten.
  while (!impl_->server.is_running()) std::this_thread::yield();
  impl_->server.stop();
  impl_->thread.join();
}

int WatchPage::port() const { return impl_->port; }

void WatchPage::Add(const WatchEvent& event) {
  nlohmann::json json = ToJson(event);
  json["line"] = ToText(event);
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->events.push_back(std::move(json));
  if (impl_->events.size() > kShownEvents) impl_->events.pop_front();
}

void WatchPage::Show(const WatchState& state) {
  nlohmann::json joints = nlohmann::json::array();
  for (int j = 0; j < impl_->robot.num_joints(); ++j) {
    const Joint& joint = impl_->robot.links[j].joint;
    joints.push_back({{"name", joint.name},
                      {"unit", EffortUnit(joint.type)},
                      {"residual", NumberOrNull(state.residual, j)},
                      {"limit", NumberOrNull(state.limit, j)}});
  }
  nlohmann::json changes = nlohmann::json::array();
  for (const WatchedValue& value : state.changes) {
    changes.push_back({{"name", value.name},
                       {"unit", value.unit},
                       {"value", value.value},
                       {"stddev", value.stddev}});
  }
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->json = {{"robot", impl_->robot.name}, {"time", state.time},
                 {"learning", state.learning}, {"contact", state.contact},
                 {"joints", joints},           {"changes", changes}};
}

}  // namespace armcal
