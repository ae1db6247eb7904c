// The C interface: what other languages and the browser link (docs/c.md).
#pragma once

#include <stddef.h>
#include <stdint.h>

#define CALLIGRAPHY_VERSION_MAJOR 0  ///< of this header; calligraphy_version() returns that of the library
#define CALLIGRAPHY_VERSION_MINOR 2  ///< changes whenever programs must be recompiled
#define CALLIGRAPHY_VERSION_PATCH 0  ///< changes otherwise

#if defined(_WIN32) && defined(CALLIGRAPHY_C_BUILD)
#define CALLIGRAPHY_API __declspec(dllexport)
#elif defined(_WIN32)
#define CALLIGRAPHY_API __declspec(dllimport)
#else
#define CALLIGRAPHY_API __attribute__((visibility("default")))  ///< a function of the shared library
#endif

#ifdef __cplusplus
extern "C" {
#endif

// Conventions.
//
// Units are the same as in C++: metres, newtons, seconds. The origin of the page is its lower left corner; x points
// right, y up and z out of the paper.
//
// Handles are opaque. Their creator frees them with calligraphy_free(), in any order: an object may be freed before
// others that were made from it, though not while another thread is in a call that uses it. A handle that is null, was
// freed or is of another kind is refused, never dereferenced. Use a handle in one thread at a time unless a comment
// says otherwise; using a servo also uses its device and its renderer.
//
// Every struct begins with its size, which the caller sets: `calligraphy_tick tick = {sizeof tick};`. With a wrong size
// the library may write beyond the variable. The size allows structs to grow at their end: a newer library accepts
// those of an older program, and an older library those of a newer program, unless that sets members that the library
// does not know. All members of results may be left at zero; members of an input may be if a comment says what zero
// means.
//
// Functions return a status. On failure they do nothing else, and calligraphy_last_error() says which value was wrong
// and why. No function throws or ends the program, except that reading a set from a file ends it if the file has been
// truncated since it was opened. The library calls functions of the program only if they are set as its guidance law.
// It neither reads nor writes through an optional pointer that is null.
//
// If the library was loaded at run time, by dlopen(), the first step or error in a thread allocates memory for that
// thread, unless calligraphy_last_error() was called in it before.

/// Result of a function call.
typedef enum calligraphy_status {
  CALLIGRAPHY_OK = 0,              ///< success
  CALLIGRAPHY_INVALID_HANDLE = 1,  ///< a handle that is null, freed, or of another kind of object or device
  CALLIGRAPHY_INVALID_VALUE = 2,   ///< a value out of its domain, a null pointer or a struct of the wrong size
  CALLIGRAPHY_NOT_FOUND = 3,       ///< no such character in the set
  CALLIGRAPHY_TOO_SMALL = 4,       ///< an array is too small for the result
  CALLIGRAPHY_FILE_ERROR = 5,      ///< a file cannot be opened or read
  CALLIGRAPHY_FORMAT_ERROR = 6,    ///< malformed input
  CALLIGRAPHY_OUT_OF_MEMORY = 7,   ///< no memory is left, or all 65,536 handles are in use
  CALLIGRAPHY_INTERNAL_ERROR = 8   ///< a defect of this library
} calligraphy_status;

/// Version of the library: "0.2.0". In static storage.
CALLIGRAPHY_API const char* calligraphy_version(void);

/// Message of the last failure in this thread, in UTF-8; empty if nothing failed. Valid until the next failure in this
/// thread, and unchanged by functions that succeed.
CALLIGRAPHY_API const char* calligraphy_last_error(void);

/// Frees a handle of any kind. Does nothing for null.
CALLIGRAPHY_API calligraphy_status calligraphy_free(void* handle);

// Characters.

/// A set of characters. Any number of threads may use one.
typedef struct calligraphy_set calligraphy_set;

/// The characters drawn for this library.
CALLIGRAPHY_API calligraphy_status calligraphy_set_built_in(calligraphy_set** set);

/// The 39 typical strokes, to be practised alone: characters of one stroke, from ㇀ (U+31C0) to ㇥ (U+31E5) but two, and by
/// their numbers ① (U+2460) to ㊴ (U+32B4), docs/strokes.md.
CALLIGRAPHY_API calligraphy_status calligraphy_set_typical_strokes(calligraphy_set** set);

/// Opens a set file, or a file in the text format (docs/set-file.md, docs/character-format.md); `path` is in UTF-8.
CALLIGRAPHY_API calligraphy_status calligraphy_set_open(const char* path, calligraphy_set** set);

/// A set from the bytes of a set file, which are copied. `name` is used in messages; null: "memory".
CALLIGRAPHY_API calligraphy_status calligraphy_set_from_memory(const void* bytes, size_t size, const char* name,
                                                               calligraphy_set** set);

/// The first character of the set at or after the code point `from`. CALLIGRAPHY_NOT_FOUND past the last one. To list
/// all of them, continue from each one plus 1.
CALLIGRAPHY_API calligraphy_status calligraphy_set_next(const calligraphy_set* set, uint32_t from, uint32_t* code);

/// Number of strokes of a character. CALLIGRAPHY_NOT_FOUND if the set does not have it; CALLIGRAPHY_FORMAT_ERROR if it
/// is damaged.
CALLIGRAPHY_API calligraphy_status calligraphy_set_stroke_count(const calligraphy_set* set, uint32_t code,
                                                                int32_t* stroke_count);

/// A character of a text.
typedef struct calligraphy_text_character {
  uint32_t size;      ///< sizeof(calligraphy_text_character)
  uint32_t written;   ///< code point in the text
  uint32_t code;      ///< code point under which the set has it: `written`, or the unified ideograph that it stands for
  uint32_t selector;  ///< variation selector after it, which has no effect; 0: none
  const char* note;   ///< what a person is to be told of this, mostly nothing: ""; valid until the next call in this thread
} calligraphy_text_character;

/// Reads a character of a text in UTF-8 by its index, from 0. White space and code points without ink do not count.
/// CALLIGRAPHY_NOT_FOUND past the last one; whether the set has it must be asked elsewhere.
CALLIGRAPHY_API calligraphy_status calligraphy_text_read(const calligraphy_set* set, const char* text, int32_t index,
                                                         calligraphy_text_character* character);

// Pages.

/// Placed characters, in the order in which they are to be written. Any number of threads may use one.
typedef struct calligraphy_page calligraphy_page;

/// Size of a page, and of the squares on it. Members that are zero take the default.
typedef struct calligraphy_layout {
  uint32_t size;  ///< sizeof(calligraphy_layout)
  double width;   ///< width of the page; 0.16 by default [m]
  double height;  ///< height of the page; 0.12 by default [m]
  double em;      ///< edge length of a character's square; 0.04 by default [m]
  double gap;     ///< between the squares, and between them and the edge of the page; 0.2 em by default [m]
} calligraphy_layout;

/// Lays out the characters of a text in UTF-8, as calligraphy_text_read() reads them, from left to right and top to
/// bottom; all must be in the set. Writes how many fit, from the first on, to `placed`; if that is null, all must fit.
/// Null `layout`: the default.
CALLIGRAPHY_API calligraphy_status calligraphy_page_lay_out(const calligraphy_set* set, const char* text,
                                                            const calligraphy_layout* layout, int32_t* placed,
                                                            calligraphy_page** page);

/// Size of a page, and its number of characters.
typedef struct calligraphy_page_info {
  uint32_t size;            ///< sizeof(calligraphy_page_info)
  int32_t character_count;  ///< number of characters
  double width;             ///< width of the paper [m]
  double height;            ///< height of the paper [m]
} calligraphy_page_info;

/// Reads the size of a page and its number of characters.
CALLIGRAPHY_API calligraphy_status calligraphy_page_read_info(const calligraphy_page* page,
                                                              calligraphy_page_info* info);

/// A character of a page.
typedef struct calligraphy_placed_character {
  uint32_t size;         ///< sizeof(calligraphy_placed_character)
  uint32_t code;         ///< Unicode code point
  int32_t stroke_count;  ///< number of strokes
  int32_t has_ink;       ///< whether its strokes have their own outlines; otherwise those of a typical brush
  double origin[2];      ///< lower left corner of its square [m, page]
  double em;             ///< edge of its square [m]
} calligraphy_placed_character;

/// The character with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_page_character(const calligraphy_page* page, int32_t character,
                                                              calligraphy_placed_character* result);

/// A stroke of a page.
typedef struct calligraphy_stroke {
  uint32_t size;          ///< sizeof(calligraphy_stroke)
  int32_t id;             ///< id of its typical stroke, 1 to 39
  int32_t element_count;  ///< number of its lines and curves
  double start[2];        ///< where it begins [m, page]
  double direction[2];    ///< unit vector in which it begins; zero for a point
  double end[2];          ///< where it ends [m, page]
  double length;          ///< length of its path [m]
} calligraphy_stroke;

/// The stroke with this index of the character with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_page_stroke(const calligraphy_page* page, int32_t character,
                                                           int32_t stroke, calligraphy_stroke* result);

/// Which line of a stroke is drawn.
typedef enum calligraphy_shape {
  CALLIGRAPHY_PATH = 0,    ///< the path of the pen, from start to end
  CALLIGRAPHY_OUTLINE = 1  ///< the outline of its ink, a closed polygon to be filled by the nonzero rule
} calligraphy_shape;

/// A calligraphy_shape of a stroke as a polyline within `tolerance` of it [m]; 0: a ten-thousandth of the character's
/// square. Writes the number of points to `count` and, unless `points` is null, x and y of each to it [m, page]. If
/// `capacity`, in points, is less than `count`, returns CALLIGRAPHY_TOO_SMALL and writes no point.
CALLIGRAPHY_API calligraphy_status calligraphy_page_polyline(const calligraphy_page* page, int32_t character,
                                                             int32_t stroke, int32_t shape, double tolerance,
                                                             double* points, size_t capacity, size_t* count);

// From device axes to page axes.

/// How the page lies in the axes of the device.
typedef enum calligraphy_pose {
  CALLIGRAPHY_UPRIGHT = 0,  ///< in its x-y plane, facing z
  CALLIGRAPHY_DESK = 1      ///< flat on the desk: page y is -z of the device
} calligraphy_pose;

/// Rigid transform from device axes to page axes, with a motion scale: offset + scale * rotation * position.
typedef struct calligraphy_mapping {
  uint32_t size;       ///< sizeof(calligraphy_mapping)
  double rotation[9];  ///< row by row
  double offset[3];    ///< position of the device's origin on the page [m]
  double scale;        ///< how far the pen moves on the page for each metre of the device [1]
} calligraphy_mapping;

/// The mapping that puts the centre of the page at the origin of the device, in a calligraphy_pose.
CALLIGRAPHY_API calligraphy_status calligraphy_page_mapping(const calligraphy_page* page, int32_t pose, double scale,
                                                            calligraphy_mapping* mapping);

/// Converts a position on the page to device axes (3 values each) [m].
CALLIGRAPHY_API calligraphy_status calligraphy_mapping_to_device(const calligraphy_mapping* mapping, const double* page,
                                                                 double* device);

// Devices.

/// A device's limits, and its properties as a point mass. It senses and drives all three translations.
typedef struct calligraphy_capabilities {
  uint32_t size;              ///< sizeof(calligraphy_capabilities)
  char name[44];              ///< for messages, in UTF-8, terminated by a zero
  int32_t simulated;          ///< 1: not a real device, so unstable stiffnesses may be tried
  int32_t velocity_measured;  ///< its velocities are measured; otherwise estimated from its positions
  int32_t sample_delay;       ///< age of a sample when it is read [ticks]
  double workspace[3];        ///< extent along each device axis, centred on zero [m]
  double peak_force;          ///< maximum force, above 0; infinite: no limit [N]
  double continuous_force;    ///< force that it sustains indefinitely; 0: unknown [N]
  double usable_stiffness;    ///< maximum stiffness reported by its users; 0: unknown [N/m]
  double force_step;          ///< forces are rounded to multiples of it; 0: unknown, or they are not [N]
  double encoder_step;        ///< positions are rounded to multiples of it; 0: unknown, or they are not [m]
  double velocity_cutoff;     ///< cut-off frequency of the filter for an estimated velocity, above 0 [Hz]
  double update_rate;         ///< rate of the samples and the servo loop, above 0 [Hz]
  double apparent_mass;       ///< at the tip; 0: unknown [kg]
  double viscous_friction;    ///< damping of the mechanism itself [N s/m]
  double coulomb_friction;    ///< back-drive friction [N]
} calligraphy_capabilities;

/// A built-in profile: "omni", "touch", "desktop", "premium-1.5" or "ideal" (docs/devices.md).
CALLIGRAPHY_API calligraphy_status calligraphy_device_profile(const char* name, calligraphy_capabilities* capabilities);

/// Validity of a sample.
typedef enum calligraphy_device_status {
  CALLIGRAPHY_DEVICE_OK = 0,                 ///< a fresh sample
  CALLIGRAPHY_DEVICE_STALE = 1,              ///< the previous sample again: no new one has arrived
  CALLIGRAPHY_DEVICE_DISCONNECTED = 2,       ///< the device is gone
  CALLIGRAPHY_DEVICE_WARM_MOTORS = 3,        ///< the device limits its force to protect its motors
  CALLIGRAPHY_DEVICE_NEEDS_CALIBRATION = 4,  ///< positions are not yet absolute
  CALLIGRAPHY_DEVICE_FAULT = 5               ///< the device cannot continue
} calligraphy_device_status;

/// Quantities that a pen may sense besides its place: bits of what is known of them.
typedef enum calligraphy_stylus_quantity {
  CALLIGRAPHY_STYLUS_PRESSURE = 1,  ///< of the tip, in its full range: 0 to 1 [1]
  CALLIGRAPHY_STYLUS_FORCE = 2,     ///< of the tip on the paper [N]
  CALLIGRAPHY_STYLUS_ALTITUDE = 4,  ///< of the barrel above the x-y plane, up to pi/2 [rad]
  CALLIGRAPHY_STYLUS_AZIMUTH = 8,   ///< of the barrel: from x towards y [rad]
  CALLIGRAPHY_STYLUS_TWIST = 16,    ///< about the barrel, counterclockwise from above [rad]
  CALLIGRAPHY_STYLUS_HEIGHT = 32    ///< of the tip above the paper [m]
} calligraphy_stylus_quantity;

/// Bits of the buttons of a pen, as in W3C Pointer Events.
typedef enum calligraphy_button {
  CALLIGRAPHY_BUTTON_TIP = 1,     ///< the tip is on the paper
  CALLIGRAPHY_BUTTON_BARREL = 2,  ///< the button of the barrel is pressed
  CALLIGRAPHY_BUTTON_ERASER = 32  ///< the eraser is on the paper
} calligraphy_button;

/// What a pen senses besides its place, in the axes of its device or of the paper. Members that are not among the
/// `known` ones may be zero.
///
/// In a browser, `altitude` is altitudeAngle, `azimuth` is -azimuthAngle, and `twist` is minus the event's twist in
/// radians, since the y axis of a screen points down.
typedef struct calligraphy_stylus {
  uint32_t size;    ///< sizeof(calligraphy_stylus)
  uint32_t known;   ///< sum of the bits of calligraphy_stylus_quantity that the pen senses; 0: none
  double pressure;  ///< CALLIGRAPHY_STYLUS_PRESSURE [1]
  double force;     ///< CALLIGRAPHY_STYLUS_FORCE [N]
  double altitude;  ///< CALLIGRAPHY_STYLUS_ALTITUDE [rad]
  double azimuth;   ///< CALLIGRAPHY_STYLUS_AZIMUTH [rad]
  double twist;     ///< CALLIGRAPHY_STYLUS_TWIST [rad]
  double height;    ///< CALLIGRAPHY_STYLUS_HEIGHT [m]
} calligraphy_stylus;

/// One sample of a device, in device axes. Its last members are those of calligraphy_stylus; in results they are NaN
/// where the pen does not sense them.
typedef struct calligraphy_device_state {
  uint32_t size;          ///< sizeof(calligraphy_device_state)
  int32_t status;         ///< a calligraphy_device_status
  uint32_t buttons;       ///< one bit per button
  int32_t has_velocity;   ///< whether `velocity` is known
  int32_t has_force;      ///< whether `force` is known
  double time;            ///< since the device was opened [s]
  double position[3];     ///< haptic interface point [m]
  double velocity[3];     ///< velocity of the haptic interface point [m/s]
  double force[3];        ///< force at work when the sample is read, for the energy budget [N]
  double force_settling;  ///< how long after the previous sample another force may have been at work [s]
  uint32_t stylus_known;   ///< sum of the bits of calligraphy_stylus_quantity that the pen senses; 0: none
  double stylus_pressure;  ///< CALLIGRAPHY_STYLUS_PRESSURE [1]
  double stylus_force;     ///< CALLIGRAPHY_STYLUS_FORCE [N]
  double stylus_altitude;  ///< CALLIGRAPHY_STYLUS_ALTITUDE [rad]
  double stylus_azimuth;   ///< CALLIGRAPHY_STYLUS_AZIMUTH [rad]
  double stylus_twist;     ///< CALLIGRAPHY_STYLUS_TWIST [rad]
  double stylus_height;    ///< CALLIGRAPHY_STYLUS_HEIGHT [m]
} calligraphy_device_state;

/// A simulated device with the hand that holds it, or a device implemented by the program.
typedef struct calligraphy_device calligraphy_device;

/// Impedance of the hand about its intended position, equal along all axes. All zero: nobody holds the device.
typedef struct calligraphy_grip {
  uint32_t size;     ///< sizeof(calligraphy_grip)
  double mass;       ///< mass that moves with the device, usually 0.1 [kg]
  double damping;    ///< damping of motion relative to the intended one, usually 3 [N s/m]
  double stiffness;  ///< stiffness of the spring towards the intended position, usually 300 [N/m]
} calligraphy_grip;

/// A simulated device at rest at `position` (device axes, 3 values) [m]. Null `grip`: the usual one.
CALLIGRAPHY_API calligraphy_status calligraphy_simulated_device_create(const calligraphy_capabilities* capabilities,
                                                                       const calligraphy_grip* grip,
                                                                       const double* position,
                                                                       calligraphy_device** device);

/// How the hand of a pointer device follows the pointer. Members that are zero take the default.
typedef struct calligraphy_pointer_options {
  uint32_t size;          ///< sizeof(calligraphy_pointer_options)
  double rate;            ///< rate at which the device is read; its own by default [Hz]
  double smoothing_time;  ///< lag of the intended position behind the pointer; 0.03 by default [s]
  double max_speed;       ///< speed limit of the intended position along the paper; 0.5 by default [m/s]
  double lifting_speed;   ///< its speed towards and away from the paper; 0.12 by default [m/s]
  double hover_height;    ///< height above the paper while the pointer is not pressed; 0.008 by default [m]
  double press_depth;     ///< depth below the paper at full pressure; 0.005 by default [m]
} calligraphy_pointer_options;

/// A simulated device in a hand that follows a mouse, tablet or finger on a page with this mapping. Every read advances
/// it by one period. Null `grip` or `options`: the usual ones.
CALLIGRAPHY_API calligraphy_status calligraphy_pointer_device_create(const calligraphy_capabilities* capabilities,
                                                                     const calligraphy_grip* grip,
                                                                     const calligraphy_pointer_options* options,
                                                                     const calligraphy_mapping* mapping,
                                                                     calligraphy_device** device);

/// Sets the position of the pointer [m, page] and its pressure, from 0 (not pressed) to 1; use 0.5 for a mouse button.
/// Wait-free; may be called from another thread than the one that reads the device. Only for a pointer device.
CALLIGRAPHY_API calligraphy_status calligraphy_device_move_pointer(calligraphy_device* device, double x, double y,
                                                                   double pressure, uint32_t buttons);

/// As calligraphy_device_move_pointer(), with what the pen of a tablet senses, which the samples of the device have as
/// it is; its pressure there does not move the hand. Null `stylus`: nothing.
CALLIGRAPHY_API calligraphy_status calligraphy_device_move_pen(calligraphy_device* device, double x, double y,
                                                               double pressure, uint32_t buttons,
                                                               const calligraphy_stylus* stylus);

/// Sets where the hand intends the pen to be, and the velocity at which it moves on (3 values each, device
/// axes) [m, m/s]. Null `velocity`: zero. Only for a simulated device.
CALLIGRAPHY_API calligraphy_status calligraphy_device_intend(calligraphy_device* device, const double* position,
                                                             const double* velocity);

/// Advances virtual time by `seconds`, with the force held, and takes a sample. Only for a simulated device.
CALLIGRAPHY_API calligraphy_status calligraphy_device_advance(calligraphy_device* device, double seconds);

/// The newest sample. Only for simulated and pointer devices.
CALLIGRAPHY_API calligraphy_status calligraphy_device_read(calligraphy_device* device, calligraphy_device_state* state);

/// Commands a force (3 values, device axes), held until the next one [N]. A force that is not finite is an error and
/// counts as zero. Only for simulated and pointer devices.
CALLIGRAPHY_API calligraphy_status calligraphy_device_write(calligraphy_device* device, const double* force);

/// A device implemented by the program, for a servo: the program supplies its samples and sends it the ticks' forces.
CALLIGRAPHY_API calligraphy_status calligraphy_host_device_create(const calligraphy_capabilities* capabilities,
                                                                  calligraphy_device** device);

/// Supplies the sample for the next step of a servo. A step without a new sample gets a stale one, or the same fault
/// again. Only for a host device.
CALLIGRAPHY_API calligraphy_status calligraphy_device_supply(calligraphy_device* device,
                                                             const calligraphy_device_state* state);

// The renderer.

/// Whether the rules of the paper are used as revised or as printed (docs/wang2006.md).
typedef enum calligraphy_rules {
  CALLIGRAPHY_RULES_REVISED = 0,  ///< all revised
  CALLIGRAPHY_RULES_WANG2006 = 1  ///< all as printed, except the signs of eq. (8) and (9)
} calligraphy_rules;

/// What to do with a stiffness above what is usable or stable on the device.
typedef enum calligraphy_stiffness_check {
  CALLIGRAPHY_STIFFNESS_REJECT = 0,  ///< calligraphy_renderer_create() fails
  CALLIGRAPHY_STIFFNESS_CLIP = 1,    ///< use the maximum permitted value; calligraphy_renderer_clipped() says why
  CALLIGRAPHY_STIFFNESS_OFF = 2      ///< accept it, on simulated devices only
} calligraphy_stiffness_check;

/// How the nearest point of a stroke is found (docs/nearest-point.md).
typedef enum calligraphy_nearest_method {
  CALLIGRAPHY_NEAREST_EXACT = 0,    ///< the global nearest point, certified
  CALLIGRAPHY_NEAREST_TRACKED = 1,  ///< the same, found from the last one
  CALLIGRAPHY_NEAREST_SAMPLED = 2,  ///< fast, but wrong where another branch is nearly as near
  CALLIGRAPHY_NEAREST_WANG2006 = 3  ///< as printed
} calligraphy_nearest_method;

/// How the guidance force depends on where the pen is.
typedef enum calligraphy_guidance_law {
  CALLIGRAPHY_GUIDANCE_LINEAR = 0,      ///< a spring within the constraint space, nothing outside
  CALLIGRAPHY_GUIDANCE_SATURATING = 1,  ///< a spring that levels off towards guidance_limit, at any distance
  CALLIGRAPHY_GUIDANCE_WANG2006 = 2,    ///< the linear one as printed, which never lets go
  CALLIGRAPHY_GUIDANCE_OWN = 3          ///< a law of the program's own, calligraphy_guidance_functions
} calligraphy_guidance_law;

/// Input of a guidance law for one tick: where the pen is, in the page frame, and what the law is asked to do.
typedef struct calligraphy_guidance_input {
  uint32_t size;         ///< size of the struct in the library, which sets it
  int32_t writing;       ///< the stroke is being written; otherwise the pen is on the way to its start
  double tip[2];         ///< pen tip [m]
  double velocity[2];    ///< estimated velocity of the tip [m/s]
  double target[2];      ///< where guidance leads: nearest point, or one on the way to the start or past the end [m]
  double way[2];         ///< from the tip to the target [m]
  double tangent[2];     ///< tangent of the stroke at its nearest point, in writing direction; unit vector
  double stiffness;      ///< guidance_stiffness times `attraction`, limited to what the device permits [N/m]
  double damping;        ///< effective guidance_damping [N s/m]
  double attraction;     ///< attraction factor there, eq. (8): 1 on most strokes
  double weight;         ///< weight of the constraint space: 0 outside it; 1 before the stroke is begun
  double share;          ///< factor on the force: that of the assist policy, times `weight` for a law that lets go [1]
  double resistance;     ///< where writing backwards is resisted: share of `damping` along the stroke too [1]
  double nearest[2];     ///< nearest point of the stroke; before it is begun, its start [m]
  double distance;       ///< from the tip to `nearest` [m]
  double curvature;      ///< curvature of the stroke there, positive to the left [1/m]
  double feature[2];     ///< feature point that ends the element there [m]
  double arc;            ///< length of the stroke up to `nearest` [m]
  double left;           ///< length from there to its end [m]
  double backwards;      ///< length by which the pen is behind the furthest point that it reached [m]
  double to_start[2];    ///< from the tip to the start of the stroke [m]
  double depth;          ///< depth of the device below the paper [m]
  double em;             ///< edge of the character's square [m]
  double dt;             ///< period of the servo loop [s]
  double max_stiffness;  ///< maximum stable in any hand, next to the other springs and `damping` [N/m]
} calligraphy_guidance_input;

/// Output of a guidance law: its force on the pen, in page axes. Before each call the library sets no spring, the
/// damper of the built-in laws for `share` and no normal force, so a law need only set what differs.
typedef struct calligraphy_guidance_terms {
  uint32_t size;     ///< size of the struct in the library, which sets it
  double spring[2];  ///< part that depends on where the pen is [N]
  double damper[2];  ///< part that depends on how the pen moves, which an exhausted budget can keep [N]
  double normal;     ///< normal force in addition to the paper's, out of the paper [N]
} calligraphy_guidance_terms;

/// The stroke that a guidance law last began. Owned by the renderer: not to be freed, and refused once that is gone.
typedef struct calligraphy_active_stroke calligraphy_active_stroke;

/// A place on a stroke.
typedef struct calligraphy_stroke_place {
  uint32_t size;      ///< sizeof(calligraphy_stroke_place)
  double point[2];    ///< [m, page]
  double tangent[2];  ///< unit vector in writing direction; zero for a stroke that is a point
  double curvature;   ///< positive where the stroke bends to the left [1/m]
  double length;      ///< length of the whole stroke [m]
} calligraphy_stroke_place;

/// The place at an arc length [m] from the start, which is clamped to the stroke (NaN counts as 0). At a corner it is
/// the end of the previous element. Neither allocates, locks nor logs.
CALLIGRAPHY_API calligraphy_status calligraphy_active_stroke_at(const calligraphy_active_stroke* stroke, double arc,
                                                                calligraphy_stroke_place* place);

/// Called before the first force of each attempt at a stroke.
typedef void calligraphy_guidance_begin(void* user, const calligraphy_active_stroke* stroke);

/// Called in each tick in which the pen is led, never in the air: it should neither allocate, lock nor log. Returns 0,
/// or another value on failure. That, or a force that is not finite, gives no force and CALLIGRAPHY_TICK_BAD_LAW.
typedef int32_t calligraphy_guidance_force(void* user, const calligraphy_guidance_input* input,
                                           calligraphy_guidance_terms* terms);

/// A guidance law of the program's own (docs/c.md). calligraphy_renderer_update() and calligraphy_servo_step() call it
/// in their thread; it must not use their renderer or servo. Renderers with the same `user` share what it points to.
/// Members that are zero take the default. A law stiffer than the device permits is refused or scaled down
/// (stiffness_check). If its stiffness is unknown, the force follows the pen at the stiffness that the device permits,
/// within an energy budget, without which a real device is refused.
typedef struct calligraphy_guidance_functions {
  uint32_t size;                      ///< sizeof(calligraphy_guidance_functions)
  int32_t never_lets_go;              ///< not even of a pen far from the stroke or pulled elsewhere by the hand
  void* user;                         ///< passed to the functions; it must live as long as the renderer
  calligraphy_guidance_begin* begin;  ///< may be null
  calligraphy_guidance_force* force;  ///< must not be null
  const char* name;                   ///< for messages, in UTF-8; "own" by default
  double stiffness;                   ///< maximum change of its force with the position of the pen; 0: unknown [N/m]
  double power;                       ///< power to lead a pen on, at most 10; added to the budget, which it needs [W]
} calligraphy_guidance_functions;

/// How exactly a stroke must be written to count as the one that is due.
typedef enum calligraphy_tolerance {
  CALLIGRAPHY_TOLERANCE_NORMAL = 0,   ///< the default
  CALLIGRAPHY_TOLERANCE_LENIENT = 1,  ///< for beginners
  CALLIGRAPHY_TOLERANCE_STRICT = 2    ///< for examinations
} calligraphy_tolerance;

/// Options of a renderer: those of RendererOptions in C++, group by group. Begin with
/// calligraphy_renderer_options_for(): zeros are not the defaults.
typedef struct calligraphy_renderer_options {
  uint32_t size;             ///< sizeof(calligraphy_renderer_options)
  int32_t rules;             ///< a calligraphy_rules
  int32_t stiffness_check;   ///< a calligraphy_stiffness_check
  int32_t nearest_method;    ///< a calligraphy_nearest_method
  double nearest_tolerance;  ///< exact, tracked: error of the point; wang2006: epsilon; relative to the element's size
  int32_t nearest_samples;   ///< sampled: number of points
  int32_t nearest_refinements;  ///< sampled: number of refinement steps
  double servo_rate;            ///< ticks per second; 0: the device's own rate [Hz]
  double velocity_cutoff;       ///< cut-off frequency of the low-pass on the pen's velocity [Hz]
  double grip_stiffness;        ///< stiffness of a usual grip [N/m, device]

  double paper_stiffness;             ///< stiffness of the paper's surface, K_en of eq. (9) [N/m]
  double paper_damping;               ///< damping of the paper's surface [N s/m]
  double paper_onset;                 ///< depth over which both rise from zero [m]
  double paper_friction_coefficient;  ///< tangential over normal force; 0: no friction [1]
  double paper_friction_stiffness;    ///< stiffness of the spring between pen and paper [N/m]
  double paper_friction_damping;      ///< damping of that spring [N s/m]

  int32_t guidance_law;                 ///< a calligraphy_guidance_law
  int32_t guidance_to_start;            ///< pull the pen to the start of the stroke that is due
  int32_t assist_enabled;               ///< let guidance fade as the writer improves
  double guidance_stiffness;            ///< stiffness of the spring to the stroke, K_et of eq. (8) [N/m]
  double guidance_damping;              ///< damping of motion across the stroke [N s/m]
  double guidance_limit;                ///< maximum force of the spring with the saturating law [N]
  double guidance_radius;               ///< distance from the stroke beyond which it does not attract [em]
  double guidance_fade_width;           ///< width of the edge in which the force fades out [em]
  double guidance_fade_in;              ///< time over which the force rises from zero [s]
  double guidance_fade_out;             ///< time over which it is withdrawn when it lets go [s]
  double guidance_wrong_way_stiffness;  ///< stiffness of the spring that resists writing backwards; 0: none [N/m]
  double guidance_wrong_way_limit;      ///< maximum force of that spring [N]
  double guidance_wrong_way_slack;      ///< length by which the pen may be behind its furthest point [em]
  double assist_retention;              ///< share of the previous assistance that is retained [1]
  double assist_full_error;             ///< error of a stroke that keeps the assistance at 1 [em]
  double assist_min;                    ///< lower bound of the assistance [1]

  double contact_lift_time;              ///< a pen above the paper counts as lifted after this time [s]
  double contact_lift_clearance;         ///< a pen this far above the paper counts as lifted at once [m]
  double contact_box_margin;             ///< margin of a character's box around its square [em]
  int32_t contact_lift_between_strokes;  ///< a stroke begins only with a new contact

  double tolerance_start_distance;  ///< a stroke begins within this distance of its start [em]
  double tolerance_direction;       ///< greatest angle between its first stretch and the stroke's own [rad]
  double tolerance_first_stretch;   ///< length of that stretch [em]
  double tolerance_distinction;     ///< factor by which a later stroke must fit better to be meant [1]
  double tolerance_corridor;        ///< half the width of the corridor within which writing counts as covered [em]
  double tolerance_coverage;        ///< share of the length that must be written in order [1]
  double tolerance_slack;           ///< length that may be missing in addition [em]

  double limit_in_plane_rate;          ///< maximum rate of the force in the paper plane; may be infinite [N/s]
  double limit_normal_rate;            ///< maximum rate of the force along the normal; may be infinite [N/s]
  double limit_thermal_time_constant;  ///< time constant of the motors; 0: heat is not considered [s]
  double limit_max_speed;              ///< a sample that implies a faster pen is a fault [m/s, device]
  double limit_max_acceleration;       ///< limit off the course of the last samples; infinite: none [m/s^2, device]
  double limit_max_standstill;         ///< a sensor that stands still for longer while the force changes is dead [s]

  double energy_budget;   ///< maximum net energy given since the start; infinite: no limit [J]
  double energy_max_gap;  ///< longest time without a fresh sample for which it must hold [s]

  const calligraphy_guidance_functions* guidance_functions;  ///< own law, copied; null otherwise, and in results

  int32_t tolerance_next_decides;  ///< a stroke that is perhaps too short is finished once the next one is begun
  int32_t reserved;                ///< 0
} calligraphy_renderer_options;

/// Which options to begin with.
typedef enum calligraphy_preset {
  CALLIGRAPHY_PRESET_DEVICE = 0,      ///< the defaults, fitted to the device: stable in any hand on it
  CALLIGRAPHY_PRESET_EVERYTHING = 1,  ///< with the optional stages that serve every writer
  CALLIGRAPHY_PRESET_WANG2006 = 2     ///< as printed; on simulated devices only
} calligraphy_preset;

/// The options of a calligraphy_preset for a device, with a motion scale (1: none) and a calligraphy_tolerance.
CALLIGRAPHY_API calligraphy_status calligraphy_renderer_options_for(const calligraphy_capabilities* capabilities,
                                                                    int32_t preset, double scale, int32_t tolerance,
                                                                    calligraphy_renderer_options* options);

/// Guides a pen through the characters of a page, stroke by stroke.
typedef struct calligraphy_renderer calligraphy_renderer;

/// A renderer for a page, with nothing written. Null `mapping`: upright, scale 1. Null `options`: those of
/// CALLIGRAPHY_PRESET_DEVICE for the mapping's scale.
CALLIGRAPHY_API calligraphy_status calligraphy_renderer_create(const calligraphy_page* page,
                                                               const calligraphy_mapping* mapping,
                                                               const calligraphy_capabilities* capabilities,
                                                               const calligraphy_renderer_options* options,
                                                               calligraphy_renderer** renderer);

/// The options in effect: stiffnesses that were clipped may be lower than requested.
CALLIGRAPHY_API calligraphy_status calligraphy_renderer_effective_options(const calligraphy_renderer* renderer,
                                                                          calligraphy_renderer_options* options);

/// The values that were clipped, one line each, with the reason; valid as long as the renderer.
CALLIGRAPHY_API calligraphy_status calligraphy_renderer_clipped(const calligraphy_renderer* renderer,
                                                                const char** lines);

/// Where the pen is, and whether it writes (Wang 2006, Table 1).
typedef enum calligraphy_interaction_state {
  CALLIGRAPHY_SEPARATION = 0,   ///< the pen does not touch the paper
  CALLIGRAPHY_ADJUSTING = 1,    ///< it touches the paper outside the box of the active character
  CALLIGRAPHY_CALIBRATION = 2,  ///< it touches the paper inside the box, but does not write the active stroke
  CALLIGRAPHY_WRITING = 3       ///< it writes the active stroke
} calligraphy_interaction_state;

/// What happened in a tick; bit flags. What becomes of a stroke is told at its end, within 50 ms of the lift, or with the
/// next CALLIGRAPHY_STROKE_STARTED, which begins the next stroke or writes this one anew. The last stroke of a character
/// may be finished in the tick of the touch that goes on, and that of a page after 1 s in the air.
typedef enum calligraphy_event {
  CALLIGRAPHY_CONTACT = 1,              ///< the pen touched the paper
  CALLIGRAPHY_LIFT = 2,                 ///< the pen left the paper
  CALLIGRAPHY_STROKE_STARTED = 4,       ///< the first stretch of the active stroke was written
  CALLIGRAPHY_FEATURE_PASSED = 8,       ///< a feature point of the active stroke was passed
  CALLIGRAPHY_STROKE_FINISHED = 16,     ///< a stroke was written; the tick's `stroke` is already the next
  CALLIGRAPHY_STROKE_ABANDONED = 32,    ///< a stroke was left before its end; its trace is to be cleared
  CALLIGRAPHY_CHARACTER_FINISHED = 64,  ///< the last stroke of a character was finished
  CALLIGRAPHY_PAGE_FINISHED = 128       ///< the last character of the page was finished
} calligraphy_event;

/// Whether the sample of a tick was usable.
typedef enum calligraphy_tick_status {
  CALLIGRAPHY_TICK_OK = 0,            ///< a fresh sample
  CALLIGRAPHY_TICK_STALE = 1,         ///< no new sample, as the device says: the force is held, then ramps down to zero
  CALLIGRAPHY_TICK_BAD_SAMPLE = 2,    ///< not finite, or too far away: the force ramps down to zero
  CALLIGRAPHY_TICK_DEVICE_FAULT = 3,  ///< reported by the device: the force ramps down to zero
  CALLIGRAPHY_TICK_BAD_CLOCK = 4,     ///< times not in seconds, or a loop not at its rate: the force ramps down to zero
  CALLIGRAPHY_TICK_BAD_LAW = 5        ///< the law failed, or its force is not finite: the force ramps down to zero
} calligraphy_tick_status;

/// Why a pen on the paper is not guided, and what a lifted one left in doubt.
typedef enum calligraphy_hint {
  CALLIGRAPHY_HINT_NONE = 0,             ///< guided, not on the paper, or back on it once everything is written
  CALLIGRAPHY_HINT_WRITE = 1,            ///< at the start of the stroke that is due: write on
  CALLIGRAPHY_HINT_TOO_FAR = 2,          ///< too far from the start
  CALLIGRAPHY_HINT_AT_END = 3,           ///< at the stroke's end
  CALLIGRAPHY_HINT_IN_MIDDLE = 4,        ///< in the middle of the stroke
  CALLIGRAPHY_HINT_WRONG_DIRECTION = 5,  ///< at the start, but moving another way
  CALLIGRAPHY_HINT_ANOTHER_STROKE = 6,   ///< moving as if to begin another stroke
  CALLIGRAPHY_HINT_OFF_STROKE = 7,       ///< writing, but too far from the stroke or pulled aside
  CALLIGRAPHY_HINT_LIFT_FIRST = 8,       ///< lift the pen first: the previous stroke has just been finished
  CALLIGRAPHY_HINT_WARM_MOTORS = 9,      ///< guided, but warm motors permit less force than that takes: let them rest
  CALLIGRAPHY_HINT_LIFTED_EARLY = 10     ///< in the air, after a perhaps too short stroke: go on, or write it again
} calligraphy_hint;

/// Result of one tick.
typedef struct calligraphy_tick {
  uint32_t size;         ///< sizeof(calligraphy_tick)
  int32_t status;        ///< a calligraphy_tick_status
  int32_t state;         ///< a calligraphy_interaction_state
  uint32_t events;       ///< bits of calligraphy_event
  int32_t hint;          ///< a calligraphy_hint
  int32_t character;     ///< index of the active character; the number of characters once all are written
  int32_t stroke;        ///< index of its active stroke; the number of strokes from the last one's end until the lift
  int32_t element;       ///< element of the stroke at the nearest point
  double time;           ///< sample time [s]
  double force[3];       ///< to be sent to the device: after all limits, with a servo also after its ramps [N, device]
  double page_force[3];  ///< the same force on the pen [N, page]
  double device_point[3];    ///< haptic interface point [m, page]
  double pen_tip[3];         ///< virtual pen tip, on the paper while the pen touches it [m, page]
  double penetration;        ///< depth of the haptic interface point in the paper [m]
  double next_start[2];      ///< start of the active stroke; zero once all are written [m, page]
  double next_direction[2];  ///< unit vector in which it begins; zero for a point, or once all are written
  double to_start[2];        ///< from the pen tip to the start of the active, or last, stroke [m, page]
  double covered;            ///< share of the stroke written last that was covered in order [1]
  double closest[2];         ///< nearest point of the stroke, while writing, when leaving and for hints [m, page]
  double tangent[2];         ///< unit vector of the stroke there, in writing direction
  double distance;           ///< from the pen tip to it [m]
  double arc;                ///< arc length from the start of the stroke to it [m]
  double backwards;          ///< how far that is behind the furthest point reached [m]
  double attraction[2];      ///< force term of guidance, before fade-in and limits [N, page]
  double wrong_way[2];       ///< force term against writing backwards, before fade-in and limits [N, page]
  double friction[2];        ///< force term of friction, before limits [N, page]
  double viscous[3];         ///< damping of guidance, friction and paper, before limits [N, page]
  double normal;             ///< force term of the paper, before limits [N, out of the paper]
  double assistance;         ///< factor on the guidance [1]
  double energy_given;       ///< net energy delivered to the hand; 0 without a budget [J]
  double heat;               ///< heat of the motors; 1: in equilibrium at the continuous force [1]
} calligraphy_tick;

/// Processes one sample, and writes the result with the force for the device to `tick`. Neither allocates, locks nor
/// logs. A sample that is not finite is no error: the tick's status says so, and the force ramps down. On failure the
/// tick's force is zero.
CALLIGRAPHY_API calligraphy_status calligraphy_renderer_update(calligraphy_renderer* renderer,
                                                               const calligraphy_device_state* state,
                                                               calligraphy_tick* tick);

/// Starts the page again, with nothing written and zero force.
CALLIGRAPHY_API calligraphy_status calligraphy_renderer_restart(calligraphy_renderer* renderer);

/// Skips the stroke that is due as though it had been written, but without an event: neither a recording nor a score
/// counts it as written. After the last stroke of a character the next character is due, and after that of the last
/// character the page counts as written. A pen on the paper must be lifted first, as after a stroke that was written.
/// The next tick shows the skip. Neither allocates, locks nor logs. Writes to `skipped`, unless it is null, whether it
/// did: not while the pen writes the stroke (CALLIGRAPHY_WRITING), nor when none is due: the page is written, or the
/// pen has not left the last stroke of the character yet.
CALLIGRAPHY_API calligraphy_status calligraphy_renderer_skip_stroke(calligraphy_renderer* renderer, int32_t* skipped);

/// The words for a tick's hint, "too far from the start: 12 mm to the upper left", in UTF-8 and terminated by a zero.
/// Empty without a hint. `language` is the code of one, such as "zh"; null: "en". For the display: it allocates.
/// CALLIGRAPHY_TOO_SMALL if the text does not fit into `capacity` bytes; 128 are enough.
CALLIGRAPHY_API calligraphy_status calligraphy_hint_text(const calligraphy_tick* tick, const char* language, char* text,
                                                         size_t capacity);

// The servo loop, in the program's own time.

/// Runs a renderer on a device with the limits, ramps and faults of the real-time loop, one step for each call. It has
/// no thread and no watchdog: between two steps the device holds its force. Freeing it sets the force to zero.
typedef struct calligraphy_servo calligraphy_servo;

/// What the force output does.
typedef enum calligraphy_servo_phase {
  CALLIGRAPHY_SERVO_ZERO = 0,     ///< no force: before the first step, or while a fault persists
  CALLIGRAPHY_SERVO_RISING = 1,   ///< the force ramps up
  CALLIGRAPHY_SERVO_RUNNING = 2,  ///< the renderer's force is output
  CALLIGRAPHY_SERVO_FALLING = 3   ///< the last force ramps down
} calligraphy_servo_phase;

/// State of a servo loop.
typedef struct calligraphy_servo_state {
  uint32_t size;          ///< sizeof(calligraphy_servo_state)
  int32_t phase;          ///< a calligraphy_servo_phase
  int32_t device_status;  ///< calligraphy_device_status of the last sample
  double gain;            ///< factor on the renderer's force, or on the held one during a ramp-down [1]
  uint64_t ticks;         ///< steps so far
  uint64_t missed;        ///< steps that were due but did not come
  char fault[24];         ///< cause of a ramp-down, until the force has ramped up again: "unplugged"; or empty
  char advice[128];       ///< what the user has to do about the device, such as calibrate it; or empty
} calligraphy_servo_state;

/// A servo loop of a device and a renderer, at the renderer's rate. Both may be freed before it. While it is used, do
/// not update the renderer in any other way. The force ramps down after 4 ms without a sample; below 500 Hz, after two
/// periods.
CALLIGRAPHY_API calligraphy_status calligraphy_servo_create(calligraphy_device* device, calligraphy_renderer* renderer,
                                                            calligraphy_servo** servo);

/// Runs one step at time `now` [s] of a clock that does not run backwards: reads the device, updates the renderer and
/// writes the force. `tick`, unless null, gets the renderer's result with the force that was written; in a step without
/// a good sample, the last result with a status and without events. On failure the tick's force is zero and the
/// device's is unchanged. Neither allocates, locks nor logs. Advance a simulated device by as much after each step.
CALLIGRAPHY_API calligraphy_status calligraphy_servo_step(calligraphy_servo* servo, double now, calligraphy_tick* tick);

/// From the next step on, ramps the force down to zero and keeps it there.
CALLIGRAPHY_API calligraphy_status calligraphy_servo_release(calligraphy_servo* servo);

/// State after the last step.
CALLIGRAPHY_API calligraphy_status calligraphy_servo_read_state(const calligraphy_servo* servo,
                                                                calligraphy_servo_state* state);

// Lessons: what a teacher does (docs/lesson.md).

/// Follows a pupil through the strokes of a page: counts misses, gives hints, shows strokes, and keeps what was
/// written. calligraphy_lesson_update() may be called by another thread than all the rest, which changes no decision.
typedef struct calligraphy_lesson calligraphy_lesson;

/// What a lesson shows, and whether it guides the pen.
typedef enum calligraphy_lesson_mode {
  CALLIGRAPHY_LESSON_GUIDED = 0,       ///< shows all strokes, and guides
  CALLIGRAPHY_LESSON_VISION = 1,       ///< shows all strokes
  CALLIGRAPHY_LESSON_NEXT_STROKE = 2,  ///< shows the stroke that is due, and guides
  CALLIGRAPHY_LESSON_MEMORY = 3,       ///< shows nothing before it was missed
  CALLIGRAPHY_LESSON_WATCH = 4         ///< writes the strokes itself: the pen does nothing and feels nothing
} calligraphy_lesson_mode;

/// How a lesson is held.
typedef struct calligraphy_lesson_options {
  uint32_t size;               ///< sizeof(calligraphy_lesson_options)
  int32_t mode;                ///< a calligraphy_lesson_mode
  int32_t misses_until_shown;  ///< a stroke that was missed so often is shown and written; 0: 2; below 0: never
  int32_t has_strength;        ///< 0: the pen is guided as the options of the renderer say; 1: by `strength`
  double strength;             ///< share of the way to the stroke over which a hand is pulled, from 0 to 0.95 [1]
  double hint_time;            ///< time for which a hint must hold before it is given; 0: 0.25 s [s]
} calligraphy_lesson_options;

/// A lesson on a page, with a device that calligraphy_lesson_update() gets the samples of. Null `mapping`: upright,
/// scale 1; null `options`: those of CALLIGRAPHY_PRESET_DEVICE; null `held`: all zero.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_create(const calligraphy_page* page,
                                                             const calligraphy_mapping* mapping,
                                                             const calligraphy_capabilities* capabilities,
                                                             const calligraphy_renderer_options* options,
                                                             const calligraphy_lesson_options* held,
                                                             calligraphy_lesson** lesson);

/// A lesson for a mouse, a finger or the pen of a tablet, with a simulated device of its own that follows it:
/// calligraphy_lesson_move_pointer() and calligraphy_lesson_advance() take the place of calligraphy_lesson_update().
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_create_for_pointer(const calligraphy_page* page,
                                                                         const calligraphy_capabilities* capabilities,
                                                                         const calligraphy_renderer_options* options,
                                                                         const calligraphy_lesson_options* held,
                                                                         calligraphy_lesson** lesson);

/// Processes one sample, as calligraphy_renderer_update(); the tick's next_start and next_direction are zero. `hand`:
/// where the pupil's own hand is, if that is known and differs from the pen, x and y [m, page]; or null.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_update(calligraphy_lesson* lesson,
                                                             const calligraphy_device_state* state, const double* hand,
                                                             calligraphy_tick* tick);

/// Kind of a pointer, as in Pointer Events.
typedef enum calligraphy_pointer_kind {
  CALLIGRAPHY_POINTER_MOUSE = 0,  ///< a mouse
  CALLIGRAPHY_POINTER_TOUCH = 1,  ///< a finger
  CALLIGRAPHY_POINTER_PEN = 2     ///< the pen of a tablet
} calligraphy_pointer_kind;

/// What a pointer does at a time.
typedef struct calligraphy_pointer_sample {
  uint32_t size;         ///< sizeof(calligraphy_pointer_sample)
  int32_t kind;          ///< a calligraphy_pointer_kind
  int32_t id;            ///< tells fingers from each other
  int32_t is_down;       ///< whether it writes
  int32_t is_cancelled;  ///< the system has taken it: what it did since it was put down is no writing
  uint32_t buttons;      ///< bits of calligraphy_button, or 0
  double time;           ///< of any clock that does not go back [s]
  double place[2];       ///< on the page [m]
} calligraphy_pointer_sample;

/// Keeps a sample of a pointer until its time has come. `stylus`: what a pen senses besides, or null.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_move_pointer(calligraphy_lesson* lesson,
                                                                   const calligraphy_pointer_sample* sample,
                                                                   const calligraphy_stylus* stylus);

/// Goes on to a time [s], before a picture is drawn. `busy`: whether time matters, because the pen writes, or something
/// is in doubt or is being shown; otherwise this need not be called again before the next sample.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_advance(calligraphy_lesson* lesson, double time, int32_t* busy);

/// What a lesson can be asked to do while it goes on.
typedef enum calligraphy_lesson_command {
  CALLIGRAPHY_LESSON_SKIP = 0,    ///< pass over the stroke that is due
  CALLIGRAPHY_LESSON_UNDO = 1,    ///< make the last stroke due again
  CALLIGRAPHY_LESSON_SHOW = 2,    ///< show the stroke that is due, and write it once
  CALLIGRAPHY_LESSON_PAUSE = 3,   ///< no force, and what the pen does is not seen
  CALLIGRAPHY_LESSON_RESUME = 4,  ///< go on after a pause, once the pen is off the paper
  CALLIGRAPHY_LESSON_IGNORE = 5   ///< what the pen-down that is going on does is no writing
} calligraphy_lesson_command;

/// Asks for something, before the next sample. CALLIGRAPHY_TOO_SMALL if 64 commands wait already.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_send(calligraphy_lesson* lesson, int32_t command);

/// Begins the page again, once the pen is off the paper.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_again(calligraphy_lesson* lesson);

/// Begins another page, likewise.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_begin(calligraphy_lesson* lesson, const calligraphy_page* page);

/// Changes options; nulls as in calligraphy_lesson_create(). Another mode begins the page again; otherwise what was
/// written stays, and the change takes effect once the pen is off the paper and nothing is in doubt.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_change(calligraphy_lesson* lesson,
                                                             const calligraphy_renderer_options* options,
                                                             const calligraphy_lesson_options* held);

/// Why a pen-down did not write the stroke that is due.
typedef enum calligraphy_refusal_reason {
  CALLIGRAPHY_REFUSAL_NONE = 0,             ///< it was not refused
  CALLIGRAPHY_REFUSAL_TOO_SHORT = 1,        ///< lifted before it could be told what it writes
  CALLIGRAPHY_REFUSAL_BACKWARDS = 2,        ///< from the stroke's end to its start
  CALLIGRAPHY_REFUSAL_LIFTED_EARLY = 3,     ///< along the stroke, but not to its end
  CALLIGRAPHY_REFUSAL_NOT_ALONG = 4,        ///< begun as the stroke, but not written along it
  CALLIGRAPHY_REFUSAL_TOO_FAR = 5,          ///< begun too far from the start
  CALLIGRAPHY_REFUSAL_AT_END = 6,           ///< begun at the stroke's end
  CALLIGRAPHY_REFUSAL_IN_MIDDLE = 7,        ///< begun in the middle of the stroke
  CALLIGRAPHY_REFUSAL_WRONG_DIRECTION = 8,  ///< begun at the start, but in another direction
  CALLIGRAPHY_REFUSAL_ANOTHER_STROKE = 9    ///< another stroke was begun
} calligraphy_refusal_reason;

/// A lesson as it is, for whoever draws it.
typedef struct calligraphy_lesson_view {
  uint32_t size;         ///< sizeof(calligraphy_lesson_view)
  int32_t mode;          ///< a calligraphy_lesson_mode
  int32_t due;           ///< index on the page of the stroke that is due; their number once there is none
  int32_t stroke_count;  ///< number of strokes of the page
  int32_t accepted;      ///< number of strokes that were written
  int32_t skipped;       ///< number of strokes that were passed over
  int32_t right_at_once;  ///< number of strokes that were accepted without a miss
  int32_t is_finished;   ///< nothing is due, and the pen was lifted
  int32_t is_paused;     ///< CALLIGRAPHY_LESSON_PAUSE
  int32_t is_on_paper;   ///< the pen
  int32_t shows_start;   ///< the start of the stroke that is due is to be marked
  int32_t hint;          ///< the calligraphy_hint that was given last, until it is out of date
  int32_t reason;        ///< the calligraphy_refusal_reason of the last pen-down, until it is out of date
  int32_t demonstrated;  ///< index on the page of the stroke that the lesson writes; -1: none
  int32_t ink_count;     ///< number of pieces of ink: calligraphy_lesson_ink
  int32_t reserved;      ///< 0
  uint64_t tick;         ///< samples so far
  uint64_t lost_ticks;   ///< that are missing from the ink, since the lesson was looked at late
  uint64_t lost_events;  ///< that did not fit into the queue
  double time;           ///< of the last sample [s]
  double pen_tip[2];     ///< of the pen, guided [m, page]
  double hand[2];        ///< where the pupil's own hand is; NaN: not known [m, page]
  double start[2];       ///< of the stroke that is due [m, page]
  double direction[2];   ///< unit vector in which it sets out
  double hint_place[2];  ///< where the pen was when the hint or the reason was given [m, page]
  double demonstrated_share;  ///< of the length of the stroke that the lesson writes [1]
  double assistance;     ///< factor on the guidance [1]
} calligraphy_lesson_view;

/// Takes over what has happened, and says how things are. What the functions below read is as of this call.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_look(calligraphy_lesson* lesson, calligraphy_lesson_view* view);

/// What became of a stroke, or of ink.
typedef enum calligraphy_stroke_fate {
  CALLIGRAPHY_FATE_OPEN = 0,      ///< still to be written; ink: nothing is decided yet
  CALLIGRAPHY_FATE_ACCEPTED = 1,  ///< written
  CALLIGRAPHY_FATE_SKIPPED = 2,   ///< passed over
  CALLIGRAPHY_FATE_REFUSED = 3,   ///< ink of a pen-down that did not write the stroke that was due
  CALLIGRAPHY_FATE_IGNORED = 4    ///< ink of a pen-down that was no writing
} calligraphy_stroke_fate;

/// A stroke of the page.
typedef struct calligraphy_lesson_stroke {
  uint32_t size;      ///< sizeof(calligraphy_lesson_stroke)
  int32_t character;  ///< index on the page of its character
  int32_t stroke;     ///< index within it
  int32_t fate;       ///< a calligraphy_stroke_fate
  int32_t misses;     ///< pen-downs that were to write it, and did not
  int32_t pen_down;   ///< number of the pen-down that wrote it; -1: none
  int32_t is_shown;   ///< its template is to be seen
  int32_t reserved;   ///< 0
} calligraphy_lesson_stroke;

/// The stroke with this index on the page.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_read_stroke(const calligraphy_lesson* lesson, int32_t index,
                                                                  calligraphy_lesson_stroke* stroke);

/// A piece of ink, of one pen-down.
typedef struct calligraphy_lesson_ink {
  uint32_t size;       ///< sizeof(calligraphy_lesson_ink)
  int32_t pen_down;    ///< number of the pen-down
  int32_t begin;       ///< index of its first point
  int32_t end;         ///< index behind its last point
  int32_t fate;        ///< a calligraphy_stroke_fate
  int32_t is_doubted;  ///< open, and the next pen-down decides: perhaps it was lifted too early
} calligraphy_lesson_ink;

/// The piece of ink with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_read_ink(const calligraphy_lesson* lesson, int32_t index,
                                                               calligraphy_lesson_ink* ink);

/// Points of ink from an index on: of each 6 numbers, x and y of the pen tip, x and y of the pupil's own hand [m,
/// page], the time [s] and the pressure of the pen [1], NaN where they are not known. `capacity`: of the array, in
/// points; `count`: how many were written.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_ink_points(const calligraphy_lesson* lesson, int32_t begin,
                                                                 double* ink, size_t capacity, size_t* count);

/// What happens in a lesson.
typedef enum calligraphy_lesson_event_kind {
  CALLIGRAPHY_LESSON_BEGUN = 0,      ///< the first stretch of a stroke was written
  CALLIGRAPHY_LESSON_ACCEPTED = 1,   ///< a stroke was written
  CALLIGRAPHY_LESSON_REFUSED = 2,    ///< a pen-down did not write the stroke that is due: a miss
  CALLIGRAPHY_LESSON_IGNORED = 3,    ///< a pen-down was no writing, such as a bounce or a palm
  CALLIGRAPHY_LESSON_HINTED = 4,     ///< a hint has lasted long enough to be given
  CALLIGRAPHY_LESSON_SHOWN = 5,      ///< the stroke that is due is shown, and written once
  CALLIGRAPHY_LESSON_SKIPPED = 6,    ///< a stroke was passed over
  CALLIGRAPHY_LESSON_UNDONE = 7,     ///< a stroke is due again
  CALLIGRAPHY_LESSON_DECLINED = 8,   ///< a command could not be carried out
  CALLIGRAPHY_LESSON_RESTARTED = 9,  ///< a page has been begun
  CALLIGRAPHY_LESSON_FINISHED = 10   ///< every stroke was accepted or skipped, and the pen lifted
} calligraphy_lesson_event_kind;

/// Something that happened in a lesson.
typedef struct calligraphy_lesson_event {
  uint32_t size;      ///< sizeof(calligraphy_lesson_event)
  int32_t kind;       ///< a calligraphy_lesson_event_kind
  int32_t reason;     ///< a calligraphy_refusal_reason
  int32_t hint;       ///< a calligraphy_hint
  int32_t character;  ///< index on the page of the character concerned
  int32_t stroke;     ///< index within it of the stroke concerned
  int32_t misses;     ///< of that stroke so far
  int32_t pen_down;   ///< number of the pen-down concerned; -1: none
  uint64_t tick;      ///< number of the sample with which it happened
  double time;        ///< of that sample [s]
  double place[2];    ///< where the pen was, or was lifted [m, page]
} calligraphy_lesson_event;

/// Takes the next event; `found` is 0 if there is none. At most 1,024 wait.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_take_event(calligraphy_lesson* lesson,
                                                                 calligraphy_lesson_event* event, int32_t* found);

/// The words for the hint, or for the reason, of the last view: "backwards: the stroke begins here"; empty without one.
/// `language` as in calligraphy_hint_text(). Valid until the next call for this lesson.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_hint_text(calligraphy_lesson* lesson, const char* language,
                                                                const char** text);

/// What is to be judged, as numbers that another thread, or another process, can be given. Null `numbers`: only
/// `count`.
CALLIGRAPHY_API calligraphy_status calligraphy_lesson_writing(const calligraphy_lesson* lesson, double* numbers,
                                                              size_t capacity, size_t* count);

// What was written.

/// The characters of a set, in all their forms, prepared for comparison with a pen. Any number of threads may use it.
typedef struct calligraphy_index calligraphy_index;

/// An index of all characters of a set: some 64 bytes a stroke. CALLIGRAPHY_FORMAT_ERROR if one is damaged.
CALLIGRAPHY_API calligraphy_status calligraphy_index_create(const calligraphy_set* set, calligraphy_index** index);

/// Which characters the pen-downs resemble, the nearest first, and how far each is from them [em]; pen-downs as for
/// calligraphy_match_strokes(), in any unit. Both arrays take `capacity` items; `count`: how many were found, at most
/// `capacity`.
CALLIGRAPHY_API calligraphy_status calligraphy_index_recognise(const calligraphy_index* index, const double* points,
                                                               const uint32_t* path_sizes, size_t path_count,
                                                               uint32_t* codes, double* distances, size_t capacity,
                                                               size_t* count);

/// Which stroke each pen-down wrote, with remarks.
typedef struct calligraphy_match calligraphy_match;

/// Matches pen-downs with the strokes of a character of a page (docs/practice.md). `points`: x and y of each point of
/// one pen-down after the other [m, page]; `path_sizes`: the number of points of each of the `path_count` pen-downs. An
/// error of position or size is not a mistake. `tolerance`: a calligraphy_tolerance, which decides how sure a remark
/// must be. `forms`: accept every order and form that this set has of the character, CALLIGRAPHY_NOT_FOUND if it has
/// none; null: only that of the page. `others`: also remark that another character of this index was written; null: do
/// not.
CALLIGRAPHY_API calligraphy_status calligraphy_match_strokes(const calligraphy_page* page, int32_t character,
                                                             const double* points, const uint32_t* path_sizes,
                                                             size_t path_count, int32_t tolerance,
                                                             const calligraphy_set* forms,
                                                             const calligraphy_index* others,
                                                             calligraphy_match** match);

/// Index of the form as which the writing was read, among those that the set has of the character; 0 without a set.
/// Strokes of the match are those of this form.
CALLIGRAPHY_API calligraphy_status calligraphy_match_accepted(const calligraphy_match* match, int32_t* accepted);

/// Direction of a pen-down along what it wrote.
typedef enum calligraphy_direction {
  CALLIGRAPHY_FORWARDS = 0,          ///< as the stroke is to be written
  CALLIGRAPHY_BACKWARDS = 1,         ///< from its end to its start
  CALLIGRAPHY_NEITHER = 2,           ///< it was drawn as another shape, or only a part of the stroke was
  CALLIGRAPHY_UNKNOWN_DIRECTION = 3  ///< a tap has no direction
} calligraphy_direction;

/// One pen-down.
typedef struct calligraphy_drawn_stroke {
  uint32_t size;         ///< sizeof(calligraphy_drawn_stroke)
  int32_t stroke;        ///< the stroke it wrote, or the first of several; -1: none
  int32_t stroke_count;  ///< strokes that it wrote; above 1: joined
  int32_t continues;     ///< it continues the stroke that the pen-down before began
  int32_t in_turn;       ///< written in order, as far as the order can be determined
  int32_t tap;           ///< too short for a stroke with a direction
  int32_t direction;     ///< a calligraphy_direction
  int32_t attempt;       ///< the stroke that it resembles, if it wrote none; -1: no stroke
  double length;         ///< over that of what it wrote, once both are aligned [1]
  double distance;       ///< mean distance from what it wrote, once both are aligned [em]
  int32_t also;          ///< the stroke to which it went on, joined though it is not the next one; -1: none
  int32_t reserved;      ///< 0
} calligraphy_drawn_stroke;

/// The pen-down with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_match_drawn(const calligraphy_match* match, int32_t path,
                                                           calligraphy_drawn_stroke* drawn);

/// Kind of a remark.
typedef enum calligraphy_remark_kind {
  CALLIGRAPHY_REMARK_ORDER = 0,      ///< strokes out of order, or two that changed places
  CALLIGRAPHY_REMARK_DIRECTION = 1,  ///< a stroke written backwards
  CALLIGRAPHY_REMARK_SHAPE = 2,      ///< a stroke drawn as another shape, or only a part of one
  CALLIGRAPHY_REMARK_JOINED = 3,     ///< strokes written without lifting the pen: no mistake of order
  CALLIGRAPHY_REMARK_BROKEN = 4,     ///< a stroke written in two pen-downs
  CALLIGRAPHY_REMARK_MISSING = 5,    ///< a stroke that was not written
  CALLIGRAPHY_REMARK_EXTRA = 6,      ///< a pen-down that matches no stroke of the character
  CALLIGRAPHY_REMARK_CHARACTER = 7,  ///< the writing is another character: then the only remark
  CALLIGRAPHY_REMARK_LOOKALIKE = 8,  ///< a note: the writing is nearer to a character that hardly differs from this one
  // Of form. Each of the first four is then the only remark.
  CALLIGRAPHY_REMARK_UNREADABLE = 9,    ///< the writing cannot be read as this character
  CALLIGRAPHY_REMARK_ORIENTATION = 10,  ///< the writing is mirrored or turned
  CALLIGRAPHY_REMARK_SEVERAL = 11,      ///< more than one character was written
  CALLIGRAPHY_REMARK_PARTS = 12,        ///< two parts of the character are in each other's place
  CALLIGRAPHY_REMARK_CROSSING = 13,     ///< a stroke goes through or beyond another, which it should meet at most
  CALLIGRAPHY_REMARK_NO_CROSSING = 14,  ///< a stroke ends at or before another that it should go through
  CALLIGRAPHY_REMARK_GAP = 15,          ///< a stroke does not reach another that it should meet
  CALLIGRAPHY_REMARK_OVERLAP = 16,      ///< a stroke is too close to another, or lies on it
  CALLIGRAPHY_REMARK_SIDE = 17,         ///< a stroke is on the other side of another
  CALLIGRAPHY_REMARK_STRAIGHT = 18,     ///< a stroke lacks its bend, or all of them do
  CALLIGRAPHY_REMARK_BENT = 19,         ///< a stroke is bent that should be straight, or should be bent less
  CALLIGRAPHY_REMARK_WAVY = 20,         ///< a stroke wavers, or all of them do
  CALLIGRAPHY_REMARK_HOOK = 21,         ///< a note: a stroke lacks its hook
  CALLIGRAPHY_REMARK_PLACE = 22,        ///< a stroke is out of place
  CALLIGRAPHY_REMARK_LENGTH = 23,       ///< a stroke is much too long or too short beside the others
  CALLIGRAPHY_REMARK_PROPORTION = 24    ///< of two strokes, the other one should be the longer
} calligraphy_remark_kind;

/// An end of a stroke.
typedef enum calligraphy_stroke_end {
  CALLIGRAPHY_NO_END = 0,  ///< neither, or not known which
  CALLIGRAPHY_START_OF_STROKE = 1,
  CALLIGRAPHY_END_OF_STROKE = 2
} calligraphy_stroke_end;

/// How a character lies on the page.
typedef enum calligraphy_orientation {
  CALLIGRAPHY_ORIENTATION_UPRIGHT = 0,
  CALLIGRAPHY_ORIENTATION_MIRRORED = 1,       ///< left and right exchanged
  CALLIGRAPHY_ORIENTATION_UPSIDE_DOWN = 2,    ///< top and bottom exchanged, as if y pointed the other way
  CALLIGRAPHY_ORIENTATION_HALF_TURNED = 3,    ///< by 180 degrees
  CALLIGRAPHY_ORIENTATION_TURNED_LEFT = 4,    ///< by 90 degrees, anticlockwise
  CALLIGRAPHY_ORIENTATION_TURNED_RIGHT = 5,   ///< by 90 degrees, clockwise
  CALLIGRAPHY_ORIENTATION_MIRRORED_LEFT = 6,  ///< mirrored, then turned left
  CALLIGRAPHY_ORIENTATION_MIRRORED_RIGHT = 7  ///< mirrored, then turned right
} calligraphy_orientation;

/// A remark: one fault, or several that are one.
typedef struct calligraphy_remark {
  uint32_t size;         ///< sizeof(calligraphy_remark)
  int32_t kind;          ///< a calligraphy_remark_kind
  int32_t path;          ///< the pen-down, or the first of several; -1: none
  int32_t path_count;    ///< pen-downs from there to the last of them
  int32_t stroke;        ///< the stroke of the character, or the first of several; -1: none
  int32_t stroke_count;  ///< strokes in a row
  int32_t other_path;    ///< the pen-down whose stroke changed places with this one, or that wrote what this attempts
  int32_t other_stroke;  ///< the one that was due, or written before, or is attempted; of form, the other of a relation
  double place[2];       ///< to point at, in the square of the character [em]
  uint32_t other_character;  ///< code point of the character that the writing is nearer to; 0: none
  int32_t direction;         ///< a calligraphy_direction: that of the pen-down, where it matters
  double length;             ///< that of the pen-down, as calligraphy_drawn_stroke has it; NaN where it does not matter [1]
  double evidence;           ///< how sure or how grave it is; infinite: always made [1]
  int32_t end;               ///< a calligraphy_stroke_end: that end of `stroke` which crosses or does not reach
  int32_t orientation;       ///< how the writing lies, one of calligraphy_orientation
  double amount;             ///< by how much it is off, of form; NaN where that cannot be measured [em]
  double offset[2];          ///< of a stroke: from its place to where it is; of an end: from the other stroke [em]
} calligraphy_remark;

/// Number of languages of texts for people.
CALLIGRAPHY_API calligraphy_status calligraphy_language_count(int32_t* count);

/// The code of the language with this index, such as "en" or "zh"; in static storage.
CALLIGRAPHY_API calligraphy_status calligraphy_language_code(int32_t index, const char** code);

/// Number of remarks.
CALLIGRAPHY_API calligraphy_status calligraphy_match_remark_count(const calligraphy_match* match, int32_t* count);

/// The remark with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_match_remark(const calligraphy_match* match, int32_t index,
                                                            calligraphy_remark* remark);

/// What the remark with this index says to people: what is wrong and what to do, in a sentence or two, in UTF-8 and
/// valid as long as the match. `language`: its code; null: English.
CALLIGRAPHY_API calligraphy_status calligraphy_match_remark_text(const calligraphy_match* match, int32_t index,
                                                                 const char* language, const char** text);

// How well it was written.

/// A page being written, tick by tick.
typedef struct calligraphy_recording calligraphy_recording;

/// An empty recording of a page. `rate`: ticks per second; 0: 1000 [Hz].
CALLIGRAPHY_API calligraphy_status calligraphy_recording_create(const calligraphy_page* page, double rate,
                                                                calligraphy_recording** recording);

/// Appends a tick, which takes 104 bytes. Add all ticks in order of time, also those with the pen in the air. Allocates
/// now and then, which a real-time loop should leave to another thread. If the hand felt no force, as with vision
/// alone, set the tick's `page_force` to zero first.
CALLIGRAPHY_API calligraphy_status calligraphy_recording_add(calligraphy_recording* recording,
                                                             const calligraphy_tick* tick);

/// As calligraphy_recording_add(), with the sample from which the tick was made, which is kept: 152 bytes more.
/// CALLIGRAPHY_INVALID_VALUE if the recording has ticks without one: it has samples of all ticks or of none.
CALLIGRAPHY_API calligraphy_status calligraphy_recording_add_with_input(calligraphy_recording* recording,
                                                                        const calligraphy_tick* tick,
                                                                        const calligraphy_device_state* input);

/// The sample from which the tick with this index was made.
CALLIGRAPHY_API calligraphy_status calligraphy_recording_input(const calligraphy_recording* recording, int32_t tick,
                                                               calligraphy_device_state* input);

/// Scores of all characters of a recording (docs/practice.md).
typedef struct calligraphy_score calligraphy_score;

/// Scores what has been written so far: a pen-down belongs to the character in whose square it lies, or to the nearest.
/// Distances are measured on the page. `tolerance`: a calligraphy_tolerance. CALLIGRAPHY_INVALID_VALUE if the ticks are
/// of another page, or a time is before the previous one.
CALLIGRAPHY_API calligraphy_status calligraphy_score_recording(const calligraphy_recording* recording,
                                                               int32_t tolerance, calligraphy_score** score);

/// Score of a character. Quantities that were not measured are NaN: errors if no stroke was written, the time if the
/// character was not completed.
typedef struct calligraphy_character_score {
  uint32_t size;               ///< sizeof(calligraphy_character_score)
  uint32_t code;               ///< Unicode code point
  int32_t stroke_count;        ///< strokes of the character
  int32_t strokes_written;     ///< of these, the ones written, wholly or for the most part
  int32_t strokes_completed;   ///< of these, the ones finished (CALLIGRAPHY_STROKE_FINISHED)
  int32_t pen_down_count;      ///< number of pen-downs
  int32_t order_mistakes;      ///< remarks of CALLIGRAPHY_REMARK_ORDER
  int32_t direction_mistakes;  ///< remarks of CALLIGRAPHY_REMARK_DIRECTION
  int32_t lost_samples;        ///< ticks without a usable position while the character was active; left out
  int32_t pen_ups;             ///< lifts between the first pen-down and the last
  int32_t velocity_peaks;      ///< number in all pen-downs; few in fluent writing
  double time;                 ///< from the first pen-down to the tick that finished the last stroke [s]
  double rms_error;            ///< RMS distance of the pen from the strokes written, over its path length [m]
  double max_error;            ///< largest distance of the pen from the strokes written [m]
  double overall_error;        ///< `rms_error` over all strokes, unwritten parts included [m]
  double coverage;             ///< share of the length of all strokes that was written in order [1]
  double dtw_distance;         ///< mean distance by dynamic time warping of the strokes written [m]
  double contour;              ///< how close the pen was to the strokes, from 0 to 1 [1]
  double external_sequence;    ///< share of the strokes that were written in order [1]
  double internal_sequence;    ///< share of the strokes that were not written backwards [1]
  double fidelity;             ///< geometric mean of these three [1]
  double mean_pressure;        ///< mean force normal to the paper while the pen is on it [N]
  double peak_force;           ///< largest force on the page [N]
  double max_force_step;       ///< largest change of that force from one tick to the next [N]
  double duration;             ///< from the first touch to the last lift [s]
  double time_on_paper;        ///< sum of the durations of the pen-downs [s]
  double time_in_air;          ///< between the pen-downs [s]
  double path_length;          ///< on the paper [m]
  double mean_speed;           ///< on the paper [m/s]
  double peak_speed;           ///< on the paper [m/s]
  double smoothness;           ///< mean over the pen-downs [1]
} calligraphy_character_score;

/// The score of the character with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_score_character(const calligraphy_score* score, int32_t character,
                                                               calligraphy_character_score* result);

/// Score of a stroke. Quantities that were not measured are NaN.
typedef struct calligraphy_stroke_score {
  uint32_t size;         ///< sizeof(calligraphy_stroke_score)
  int32_t pen_down;      ///< index of the first pen-down that wrote it; -1: none
  int32_t completed;     ///< whether it was finished (CALLIGRAPHY_STROKE_FINISHED)
  double coverage;       ///< share of its length written in order; 0 if it was written backwards [1]
  double rms_error;      ///< RMS distance of the pen from the stroke, over the length of the pen's path [m]
  double max_error;      ///< largest distance of the pen from the stroke [m]
  double overall_error;  ///< `rms_error` with the unwritten part included [m]
  double dtw_distance;   ///< distance of what was written from the stroke by dynamic time warping [m]
} calligraphy_stroke_score;

/// The stroke with this index of the character with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_score_stroke(const calligraphy_score* score, int32_t character,
                                                            int32_t stroke, calligraphy_stroke_score* result);

/// One pen-down. Quantities that were not measured are NaN, as are speeds and smoothness if it is shorter than 50 ms.
typedef struct calligraphy_pen_down_score {
  uint32_t size;           ///< sizeof(calligraphy_pen_down_score)
  int32_t velocity_peaks;  ///< 1 in a single fluent motion, more where the pen hesitates
  double begin;            ///< time of its first tick, as calligraphy_tick::time [s]
  double end;              ///< time of its last tick [s]
  double path_length;      ///< [m]
  double mean_speed;       ///< path_length / (end - begin) [m/s]
  double peak_speed;       ///< [m/s]
  double smoothness;       ///< spectral arc length (SPARC): about -1.4 in a fluent motion, lower otherwise [1]
  double mean_pressure;    ///< mean force normal to the paper [N]
} calligraphy_pen_down_score;

/// The pen-down with this index of the character with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_score_pen_down(const calligraphy_score* score, int32_t character,
                                                              int32_t path, calligraphy_pen_down_score* result);

/// Which stroke each pen-down of a character wrote, with remarks.
CALLIGRAPHY_API calligraphy_status calligraphy_score_match(const calligraphy_score* score, int32_t character,
                                                           calligraphy_match** match);

/// Scores what calligraphy_lesson_writing() returned of a lesson on a page: of the pupil's own hand where it is known,
/// and apart from the attempts.
CALLIGRAPHY_API calligraphy_status calligraphy_score_writing(const calligraphy_page* page, const double* numbers,
                                                             size_t size, int32_t tolerance, calligraphy_score** score);

/// What a score of a lesson says besides.
typedef struct calligraphy_lesson_score {
  uint32_t size;          ///< sizeof(calligraphy_lesson_score)
  int32_t accepted;       ///< number of strokes that were written
  int32_t skipped;        ///< number of strokes that were passed over
  int32_t right_at_once;  ///< number of strokes that were accepted without a miss
  int32_t remark_count;   ///< number of remarks, the gravest first; a pupil should hear 3 at once
  int32_t has_hand;       ///< the score is of the pupil's own hand
  double guided_error;    ///< RMS error of the pen that was guided, if so; otherwise NaN [m]
} calligraphy_lesson_score;

/// Of a character of a score that calligraphy_score_writing() made.
CALLIGRAPHY_API calligraphy_status calligraphy_score_lesson(const calligraphy_score* score, int32_t character,
                                                            calligraphy_lesson_score* lesson);

/// What a remark on a lesson is about.
typedef enum calligraphy_lesson_remark_kind {
  CALLIGRAPHY_LESSON_REMARK_SKIPPED = 0,  ///< strokes that were passed over
  CALLIGRAPHY_LESSON_REMARK_WRITTEN = 1,  ///< what was written in the end
  CALLIGRAPHY_LESSON_REMARK_ATTEMPTS = 2  ///< pen-downs that were refused
} calligraphy_lesson_remark_kind;

/// A remark on a lesson, in which those that are alike are one.
typedef struct calligraphy_lesson_remark {
  uint32_t size;         ///< sizeof(calligraphy_lesson_remark)
  int32_t kind;          ///< a calligraphy_lesson_remark_kind
  int32_t remark;        ///< the calligraphy_remark_kind of CALLIGRAPHY_LESSON_REMARK_WRITTEN
  int32_t reason;        ///< the calligraphy_refusal_reason of CALLIGRAPHY_LESSON_REMARK_ATTEMPTS
  int32_t count;         ///< number of strokes skipped, of remarks that are one, or of attempts
  int32_t stroke_count;  ///< number of strokes that it is about
  double place[2];       ///< where to point, in the square of the character [em]
} calligraphy_lesson_remark;

/// The remark with this index. `strokes`, unless null, gets the strokes that it is about, as many as fit into
/// `capacity`.
CALLIGRAPHY_API calligraphy_status calligraphy_score_lesson_remark(const calligraphy_score* score, int32_t character,
                                                                   int32_t index, calligraphy_lesson_remark* remark,
                                                                   int32_t* strokes, size_t capacity);

/// What it says, in a language as in calligraphy_match_remark_text(); valid as long as the score.
CALLIGRAPHY_API calligraphy_status calligraphy_score_lesson_remark_text(const calligraphy_score* score,
                                                                        int32_t character, int32_t index,
                                                                        const char* language, const char** text);

// Pen traces.

/// Recorded pens of people writing characters, one trace a character (docs/pen-traces.md).
typedef struct calligraphy_traces calligraphy_traces;

/// An empty list of traces.
CALLIGRAPHY_API calligraphy_status calligraphy_traces_create(calligraphy_traces** traces);

/// The traces of a file, from its bytes. `name` is used in messages; null: "memory".
CALLIGRAPHY_API calligraphy_status calligraphy_traces_from_memory(const void* bytes, size_t size, const char* name,
                                                                  calligraphy_traces** traces);

/// Begins a trace of the character with this code point. `set`: one word that names the source, such as the writer;
/// `em`: edge length of the writing square in the units of the file, in which places are rounded to a millionth; 0:
/// 1000 [1].
CALLIGRAPHY_API calligraphy_status calligraphy_traces_begin(calligraphy_traces* traces, uint32_t code, const char* set,
                                                            double em);

/// Where a pen is.
typedef enum calligraphy_pen_place {
  CALLIGRAPHY_PEN_DOWN = 0,   ///< on the paper
  CALLIGRAPHY_PEN_IN_AIR = 1  ///< before a pen-down, or after the last one
} calligraphy_pen_place;

/// Begins a pen-down, or a time in the air, in the last trace: a calligraphy_pen_place. The pen is in the air at most
/// once between two pen-downs.
CALLIGRAPHY_API calligraphy_status calligraphy_traces_begin_path(calligraphy_traces* traces, int32_t place);

/// Appends a sample to what was begun last: its place in the writing square, of which y points up [em], its time, which
/// never decreases within a trace [s], what the pen senses, null for nothing, and the sum of its buttons, of
/// calligraphy_button, -1 if unknown.
CALLIGRAPHY_API calligraphy_status calligraphy_traces_add(calligraphy_traces* traces, double x, double y, double time,
                                                          const calligraphy_stylus* stylus, int32_t buttons);

/// The text of a file with these traces, in UTF-8; each line of `notice` becomes a comment, null: none. Valid until the
/// next call for this text, or until the traces are freed. CALLIGRAPHY_INVALID_VALUE if it could not be read back.
CALLIGRAPHY_API calligraphy_status calligraphy_traces_text(calligraphy_traces* traces, const char* notice,
                                                           const char** text);

/// Number of traces.
CALLIGRAPHY_API calligraphy_status calligraphy_traces_count(const calligraphy_traces* traces, int32_t* count);

/// One trace.
typedef struct calligraphy_trace_info {
  uint32_t size;       ///< sizeof(calligraphy_trace_info)
  uint32_t code;       ///< Unicode code point of the character to be written
  int32_t path_count;  ///< number of pen-downs
  int32_t has_air;     ///< whether the pen in the air was recorded: then there is one time more than pen-downs
  const char* set;     ///< names the source; valid until the traces are changed or freed
  double em;           ///< edge length of the writing square in the units of the file [1]
} calligraphy_trace_info;

/// The trace with this index.
CALLIGRAPHY_API calligraphy_status calligraphy_traces_read_info(const calligraphy_traces* traces, int32_t trace,
                                                                calligraphy_trace_info* info);

/// The pen-down with this index, or the time in the air before it: a calligraphy_pen_place; that after the last
/// pen-down has its number as index. Writes the number of samples to `count` and, unless `samples` is null, 9 values of
/// each to it: x and y [em], the time [s], and the members of calligraphy_stylus from `pressure` on, NaN where they are
/// not known; and to `buttons`, unless it is null, one value of each, -1 if unknown. If `capacity`, in samples, is less
/// than `count`, returns CALLIGRAPHY_TOO_SMALL and writes no sample.
CALLIGRAPHY_API calligraphy_status calligraphy_traces_read_path(const calligraphy_traces* traces, int32_t trace,
                                                                int32_t place, int32_t path, double* samples,
                                                                int32_t* buttons, size_t capacity, size_t* count);

#ifdef __cplusplus
}
#endif
