// Requests: linux/hidraw.h. As the kernel does, a read with nothing there says EAGAIN, and EIO once the device is gone.
#include "hidraw_node.hpp"

#include <linux/hidraw.h>
#include <linux/input.h>

#include <algorithm>
#include <cerrno>

namespace calligraphy_test {

HidrawNode::HidrawNode(EmulatedDevice& device, TestBed& bed, std::string node)
    : device_(device),
      bed_(bed),
      node_(std::move(node)),
      handler_(umockdev_ioctl_base_new()),
      pollable_(bed.real_path(node_)) {
  g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(asked), this);
  g_signal_connect(handler_, "handle-read", G_CALLBACK(reads), this);
  g_signal_connect(handler_, "handle-write", G_CALLBACK(writes), this);
  g_signal_connect(handler_, "client-connected", G_CALLBACK(connected), this);
  bed_.attach(node_, handler_);
}

HidrawNode::~HidrawNode() {
  g_signal_handlers_disconnect_by_data(handler_, this);
  bed_.detach(node_);
  g_object_unref(handler_);
}

void HidrawNode::show_state() {
  pollable_.set_filled(gone_ || !device_.waiting_.empty());
  device_.happened_.notify_all();
}

void HidrawNode::unplug() {
  gone_ = true;
  show_state();
}

void HidrawNode::connected(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  HidrawNode& node = *static_cast<HidrawNode*>(self);
  const std::lock_guard<std::mutex> alone(node.device_.mutex_);
  node.clients_.add(client);
  if (node.gone_) return;
  if (node.clients_.count() == 1) node.device_.waiting_.clear();  // a report that nobody waited for is dropped
  node.device_.host_.open_nodes = node.clients_.count();
  node.show_state();
}

gboolean HidrawNode::asked(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  HidrawNode& node = *static_cast<HidrawNode*>(self);
  const gulong request = umockdev_ioctl_client_get_request(client);
  const IoctlMemory data = pointed_to(umockdev_ioctl_client_get_arg(client), 0, _IOC_SIZE(request));
  const Octets descriptor = report_descriptor();
  int error = 0;
  bool gone = false;
  {
    const std::lock_guard<std::mutex> alone(node.device_.mutex_);
    gone = node.gone_;
    node.device_.host_.identified += request == HIDIOCGRAWINFO;
    node.device_.host_.described += request == HIDIOCGRDESCSIZE;
    node.device_.happened_.notify_all();
  }
  if (gone) {
    error = ENODEV;
  } else if (!data) {
    error = EFAULT;
  } else if (request == HIDIOCGRDESCSIZE) {
    put_value(data.get(), 0, static_cast<int>(descriptor.size()));
  } else if (request == HIDIOCGRDESC) {
    put_value(data.get(), 0, static_cast<std::uint32_t>(descriptor.size()));
    put(data.get(), offsetof(hidraw_report_descriptor, value), descriptor);
  } else if (request == HIDIOCGRAWINFO) {
    const UsbIdentity& identity = node.device_.identity();
    put_value(data.get(), 0,
              hidraw_devinfo{BUS_USB, static_cast<std::int16_t>(identity.vendor),
                             static_cast<std::int16_t>(identity.product)});
  } else {
    error = ENOTTY;
  }
  umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
  return TRUE;
}

gboolean HidrawNode::reads(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  HidrawNode& node = *static_cast<HidrawNode*>(self);
  UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
  long size = -1;
  int error = 0;
  {
    const std::lock_guard<std::mutex> alone(node.device_.mutex_);
    auto& waiting = node.device_.waiting_;
    if (node.gone_) {
      error = EIO;
    } else if (waiting.empty()) {
      error = EAGAIN;
    } else if (waiting.front().error != 0) {
      error = waiting.front().error;
      waiting.pop_front();
    } else {
      const Octets report = std::move(waiting.front().bytes);
      waiting.pop_front();
      size = static_cast<long>(std::min(report.size(), static_cast<std::size_t>(data->data_len)));
      put(data, 0, std::span(report).first(static_cast<std::size_t>(size)));
    }
    node.show_state();
  }
  umockdev_ioctl_client_complete(client, size, error);
  return TRUE;
}

gboolean HidrawNode::writes(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  HidrawNode& node = *static_cast<HidrawNode*>(self);
  const UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
  const long size = data->data_len;
  int error = 0;
  {
    const std::lock_guard<std::mutex> alone(node.device_.mutex_);
    if (node.gone_) {
      error = ENODEV;
    } else if (node.device_.taking_ == Taking::stalls) {
      error = EPIPE;
    } else if (node.device_.taking_ == Taking::never) {
      error = ETIMEDOUT;
    }
  }
  // The first byte is the report number; 0 means none, and it is not transferred then.
  if (error == 0 && size > 0) {
    node.device_.took(std::as_bytes(std::span(data->data, static_cast<std::size_t>(size)).subspan(1)));
  }
  umockdev_ioctl_client_complete(client, error == 0 ? size : -1, error);
  return TRUE;
}

}  // namespace calligraphy_test
