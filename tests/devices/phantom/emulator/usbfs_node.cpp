// Requests: linux/usbdevice_fs.h; answers: those of the kernel's usbfs on which libusb 1.0 relies.
#include "usbfs_node.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>

namespace calligraphy_test {
namespace {

constexpr std::size_t setup_size = 8;
constexpr unsigned capabilities =
    USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;

/// Bits 0 to 6 number an endpoint; control transfers go both ways.
bool inward(unsigned char type, unsigned char endpoint) {
  return type != USBDEVFS_URB_TYPE_CONTROL && (endpoint & 0x80) != 0;
}

}  // namespace

UsbfsNode::UsbfsNode(EmulatedDevice& device, TestBed& bed, std::string node)
    : device_(device),
      bed_(bed),
      node_(std::move(node)),
      handler_(umockdev_ioctl_base_new()),
      pollable_(bed.real_path(node_)) {
  g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(asked), this);
  g_signal_connect(handler_, "client-connected", G_CALLBACK(connected), this);
  bed_.attach(node_, handler_);
  const int interfaces = device.identity().link == calligraphy::LinkKind::usb ? 2 : 1;
  for (int i = 0; i < interfaces; ++i) with_driver_.insert(i);
  pollable_.set_filled(true);  // no transfer is complete
}

UsbfsNode::~UsbfsNode() {
  g_signal_handlers_disconnect_by_data(handler_, this);
  bed_.detach(node_);
  g_object_unref(handler_);
}

// ---- the device's side

void UsbfsNode::deliver() {
  for (auto transfer = flying_.begin(); transfer != flying_.end();) {
    const bool wants =
        transfer->request.endpoint == in_endpoint && inward(transfer->request.type, transfer->request.endpoint);
    if (!wants || (!device_.in_halted_ && device_.waiting_.empty())) {
      ++transfer;
      continue;
    }
    int status = device_.in_halted_ ? -EPIPE : 0;
    if (!device_.in_halted_) {
      const EmulatedDevice::Waiting packet = std::move(device_.waiting_.front());
      device_.waiting_.pop_front();
      device_.in_halted_ = packet.error == EPIPE;
      const auto room = static_cast<std::size_t>(transfer->request.buffer_length);
      status = packet.error != 0 ? -packet.error : packet.bytes.size() > room ? -EOVERFLOW : 0;
      transfer->answer.assign(packet.bytes.begin(),
                              packet.bytes.begin() + static_cast<long>(std::min(room, packet.bytes.size())));
      transfer->length = static_cast<int>(transfer->answer.size());
    }
    Transfer finished = std::move(*transfer);
    transfer = flying_.erase(transfer);
    finish(std::move(finished), status);
  }
  show_state();
}

void UsbfsNode::take_held() {
  for (auto transfer = flying_.begin(); transfer != flying_.end();) {
    if (inward(transfer->request.type, transfer->request.endpoint) || !takes(*transfer)) {
      ++transfer;
      continue;
    }
    Transfer finished = std::move(*transfer);
    transfer = flying_.erase(transfer);
    const int status = finished.status;
    finish(std::move(finished), status);
  }
  show_state();
}

void UsbfsNode::unplug(UnplugOrder order) {
  gone_ = true;
  while (!flying_.empty()) {
    Transfer transfer = std::move(flying_.front());
    flying_.pop_front();
    finish(std::move(transfer), order == UnplugOrder::error_first ? -EPROTO : -ESHUTDOWN);
  }
  show_state();
}

/// Passes a packet to the device; true if the transfer is complete and has its status.
bool UsbfsNode::takes(Transfer& transfer) {
  if (device_.out_halted_ || device_.taking_ == Taking::stalls) {
    device_.out_halted_ = true;
    transfer.status = -EPIPE;
    return true;
  }
  if (device_.taking_ == Taking::never) return false;
  transfer.status = 0;
  transfer.length = transfer.request.buffer_length;
  Octets packet;
  if (transfer.buffer) packet.assign(transfer.buffer->data, transfer.buffer->data + transfer.length);
  taken_.push_back(std::move(packet));
  return true;
}

void UsbfsNode::finish(Transfer&& transfer, int status) {
  transfer.status = status;
  done_.push_back(std::move(transfer));
}

/// The node is ready while a completed transfer has not been reaped.
void UsbfsNode::show_state() {
  pollable_.set_filled(done_.empty());
  if (gone_) return;  // what the host does with a device that was replugged is the next node's to say
  const auto from_device = std::count_if(flying_.begin(), flying_.end(), [](const Transfer& transfer) {
    return transfer.request.endpoint == in_endpoint;
  });
  device_.host_.flying = static_cast<int>(from_device);
  device_.host_.held = static_cast<int>(flying_.size()) - device_.host_.flying;
  device_.happened_.notify_all();
}

void UsbfsNode::note_interfaces() {
  device_.host_.claimed.clear();
  for (const auto& [interface, client] : claimed_) device_.host_.claimed.insert(interface);
  device_.host_.with_driver = with_driver_;
  device_.happened_.notify_all();
}

// ---- the host's side

void UsbfsNode::connected(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  UsbfsNode& node = *static_cast<UsbfsNode*>(self);
  const std::lock_guard<std::mutex> alone(node.device_.mutex_);
  node.clients_.add(client);
  node.forget_closed();
}

/// Closing the node cancels a program's transfers and releases its claims.
void UsbfsNode::forget_closed() {
  const auto closed = [this](const Transfer& transfer) { return !clients_.has(transfer.client); };
  std::erase_if(flying_, closed);
  std::erase_if(done_, closed);
  if (std::erase_if(claimed_, [this](const auto& claim) { return !clients_.has(claim.second); }) > 0) note_interfaces();
  show_state();
}

gboolean UsbfsNode::asked(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  UsbfsNode& node = *static_cast<UsbfsNode*>(self);
  Reply reply;
  std::vector<Octets> taken;
  {
    const std::lock_guard<std::mutex> alone(node.device_.mutex_);
    reply = node.answer(client);
    taken.swap(node.taken_);
  }
  for (const Octets& packet : taken) node.device_.took(std::as_bytes(std::span(packet)));
  umockdev_ioctl_client_complete(client, reply.error == 0 ? reply.result : -1, reply.error);
  return TRUE;
}

UsbfsNode::Reply UsbfsNode::answer(UMockdevIoctlClient* client) {
  const gulong request = umockdev_ioctl_client_get_request(client);
  UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
  if (request == USBDEVFS_REAPURB || request == USBDEVFS_REAPURBNDELAY) return reap(client);
  if (request == USBDEVFS_DISCARDURB) return discard(client);
  if (gone_) return {-1, ENODEV};
  if (request == USBDEVFS_SUBMITURB) return submit(client);
  if (request == USBDEVFS_RESET) return {};
  const IoctlMemory data = pointed_to(argument, 0, _IOC_SIZE(request));
  if (!data) return {-1, EFAULT};
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      put_value(data.get(), 0, capabilities);
      return {};
    case USBDEVFS_CLAIMINTERFACE:
      return claim(client, static_cast<int>(read_as<unsigned>(data.get())), false);
    case USBDEVFS_DISCONNECT_CLAIM:
      return claim(client, static_cast<int>(read_as<usbdevfs_disconnect_claim>(data.get()).interface), true);
    case USBDEVFS_RELEASEINTERFACE:
      return release(client, static_cast<int>(read_as<unsigned>(data.get())));
    case USBDEVFS_IOCTL:
      return drive(read_as<usbdevfs_ioctl>(data.get()));
    case USBDEVFS_BULK:
      return transfer(data.get());
    case USBDEVFS_SETINTERFACE:
    case USBDEVFS_SETCONFIGURATION:
      return {};
    case USBDEVFS_CLEAR_HALT:
      (read_as<unsigned>(data.get()) == in_endpoint ? device_.in_halted_ : device_.out_halted_) = false;
      ++device_.host_.cleared_halts;
      return {};
    case USBDEVFS_GETDRIVER: {
      usbdevfs_getdriver driver = read_as<usbdevfs_getdriver>(data.get());
      const bool usb = device_.identity().link == calligraphy::LinkKind::usb;
      std::string name = usb ? "cdc_acm" : "usbhid";
      if (claimed_.count(static_cast<int>(driver.interface)) != 0) {
        name = "usbfs";
      } else if (with_driver_.count(static_cast<int>(driver.interface)) == 0) {
        return {-1, ENODATA};
      }
      name.copy(driver.driver, sizeof driver.driver - 1);
      driver.driver[name.size()] = 0;
      put_value(data.get(), 0, driver);
      return {};
    }
    default:
      return {-1, ENOTTY};
  }
}

UsbfsNode::Reply UsbfsNode::claim(UMockdevIoctlClient* client, int interface, bool take_from_driver) {
  const auto holder = claimed_.find(interface);
  if (holder != claimed_.end() && holder->second != client) return {-1, EBUSY};
  if (take_from_driver) with_driver_.erase(interface);
  if (with_driver_.count(interface) != 0) return {-1, EBUSY};
  claimed_[interface] = client;
  note_interfaces();
  return {};
}

UsbfsNode::Reply UsbfsNode::release(UMockdevIoctlClient* client, int interface) {
  const auto holder = claimed_.find(interface);
  if (holder == claimed_.end() || holder->second != client) return {-1, EINVAL};
  claimed_.erase(holder);
  note_interfaces();
  return {};
}

/// Detaches an interface from the system's driver, or reattaches it.
UsbfsNode::Reply UsbfsNode::drive(const usbdevfs_ioctl& request) {
  if (request.ioctl_code == static_cast<int>(USBDEVFS_DISCONNECT)) {
    if (with_driver_.erase(request.ifno) == 0) return {-1, ENODATA};
  } else if (request.ioctl_code == static_cast<int>(USBDEVFS_CONNECT)) {
    if (claimed_.count(request.ifno) != 0) return {-1, EBUSY};
    with_driver_.insert(request.ifno);
  } else {
    return {-1, ENOTTY};
  }
  note_interfaces();
  return {1, 0};
}

UsbfsNode::Reply UsbfsNode::submit(UMockdevIoctlClient* client) {
  UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
  Transfer transfer;
  transfer.client = client;
  transfer.address = read_as<std::uint64_t>(argument);
  transfer.urb = pointed_to(argument, 0, sizeof(usbdevfs_urb));
  if (!transfer.urb) return {-1, EFAULT};
  const auto urb = read_as<usbdevfs_urb>(transfer.urb.get());
  transfer.request = {urb.type, urb.endpoint, urb.buffer_length};
  transfer.buffer = pointed_to(transfer.urb.get(), offsetof(usbdevfs_urb, buffer),
                               static_cast<std::size_t>(transfer.request.buffer_length));
  if (transfer.request.type == USBDEVFS_URB_TYPE_CONTROL) {
    control(transfer);
  } else if (inward(transfer.request.type, transfer.request.endpoint)) {
    flying_.push_back(std::move(transfer));
    deliver();
    return {};
  } else if (!takes(transfer)) {
    flying_.push_back(std::move(transfer));
    show_state();
    return {};
  }
  const int status = transfer.status;
  finish(std::move(transfer), status);
  show_state();
  return {};
}

/// A transfer to the device that the caller waits for.
UsbfsNode::Reply UsbfsNode::transfer(UMockdevIoctlData* data) {
  const auto request = read_as<usbdevfs_bulktransfer>(data);
  Transfer transfer;
  transfer.request = {USBDEVFS_URB_TYPE_BULK, static_cast<unsigned char>(request.ep), static_cast<int>(request.len)};
  transfer.buffer = pointed_to(data, offsetof(usbdevfs_bulktransfer, data), request.len);
  if (inward(transfer.request.type, transfer.request.endpoint)) return {-1, EINVAL};
  if (!takes(transfer)) return {-1, ETIMEDOUT};
  return transfer.status == 0 ? Reply{transfer.length, 0} : Reply{-1, -transfer.status};
}

void UsbfsNode::control(Transfer& transfer) {
  if (!transfer.buffer || transfer.request.buffer_length < static_cast<int>(setup_size)) {
    transfer.status = -EPIPE;
    return;
  }
  const Octets setup(transfer.buffer->data, transfer.buffer->data + setup_size);
  transfer.status = device_request(transfer, setup) ? 0 : -EPIPE;
}

/// USB 2.0, sec. 9.4; PSTN devices 1.2, sec. 6.3; HID 1.11, sec. 7.
bool UsbfsNode::device_request(Transfer& transfer, const Octets& setup) {
  const std::size_t longest = setup[6] | static_cast<std::size_t>(setup[7]) << 8;
  const Octets sent(transfer.buffer->data + setup_size, transfer.buffer->data + transfer.buffer->data_len);
  const bool get_descriptor = (setup[0] == 0x80 || setup[0] == 0x81) && setup[1] == 0x06;
  if (get_descriptor) {
    Octets descriptor = setup[3] == 1      ? device_descriptor(device_.identity())
                        : setup[3] == 2    ? configuration_descriptor(device_.identity())
                        : setup[3] == 3    ? string_descriptor(device_.identity(), setup[2])
                        : setup[3] == 0x22 ? report_descriptor()
                                           : Octets();
    if (descriptor.empty()) return false;
    descriptor.resize(std::min(descriptor.size(), longest));
    transfer.answer = descriptor;
    transfer.length = static_cast<int>(descriptor.size());
    return true;
  }
  transfer.length = static_cast<int>(longest);
  if (setup[0] == 0x21 && setup[1] == 0x20) {
    device_.host_.line_coding = sent;
  } else if (setup[0] == 0x21 && setup[1] == 0x22) {
    device_.host_.control_line = setup[2];
  } else if (setup[0] == 0x21 && setup[1] == 0x09) {
    taken_.push_back(sent);
  } else {
    return false;
  }
  device_.happened_.notify_all();
  return true;
}

UsbfsNode::Reply UsbfsNode::reap(UMockdevIoctlClient* client) {
  const auto found = std::find_if(done_.begin(), done_.end(),
                                  [client](const Transfer& transfer) { return transfer.client == client; });
  if (found == done_.end()) return {-1, gone_ ? ENODEV : EAGAIN};
  Transfer transfer = std::move(*found);
  done_.erase(found);
  if (transfer.buffer) {
    const std::size_t start = transfer.request.type == USBDEVFS_URB_TYPE_CONTROL ? setup_size : 0;
    put(transfer.buffer.get(), start, transfer.answer);
  }
  put_value(transfer.urb.get(), offsetof(usbdevfs_urb, status), transfer.status);
  put_value(transfer.urb.get(), offsetof(usbdevfs_urb, actual_length), transfer.length);
  const IoctlMemory place = pointed_to(umockdev_ioctl_client_get_arg(client), 0, sizeof(void*));
  umockdev_ioctl_data_set_ptr(place.get(), 0, transfer.urb.get());
  show_state();
  return {};
}

UsbfsNode::Reply UsbfsNode::discard(UMockdevIoctlClient* client) {
  const auto address = read_as<std::uint64_t>(umockdev_ioctl_client_get_arg(client));
  const auto found = std::find_if(flying_.begin(), flying_.end(), [&](const Transfer& transfer) {
    return transfer.client == client && transfer.address == address;
  });
  if (found == flying_.end()) return {-1, gone_ ? ENODEV : EINVAL};
  Transfer transfer = std::move(*found);
  flying_.erase(found);
  finish(std::move(transfer), -ENOENT);
  show_state();
  return {};
}

}  // namespace calligraphy_test
