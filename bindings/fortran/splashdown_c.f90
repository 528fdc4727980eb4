!> The functions of bindings/c/include/splashdown.h as they are, with their structures and constants.
module splashdown_c
  use, intrinsic :: iso_c_binding
  implicit none
  public

  !> What of the body the host moves: its reference point and angle; its corners, straight between them; or bent between them.
  integer(c_int32_t), parameter :: SPLASHDOWN_BODY = 0, SPLASHDOWN_NODES = 1, SPLASHDOWN_TURNING_NODES = 2

  !> Values of stat.
  integer(c_int), parameter :: &
      SPLASHDOWN_OK = 0, SPLASHDOWN_NULL = 1, SPLASHDOWN_LENGTH = 2, SPLASHDOWN_NOT_UTF8 = 3, SPLASHDOWN_INPUT = 4, &
      SPLASHDOWN_STEP = 5, SPLASHDOWN_FAILED = 6, SPLASHDOWN_NOTHING_SAVED = 7, SPLASHDOWN_NO_STATE = 8, &
      SPLASHDOWN_FILE = 9, SPLASHDOWN_BUSY = 10, SPLASHDOWN_NO_HANDLE = 11, SPLASHDOWN_PANIC = 12, &
      SPLASHDOWN_AFTER_PANIC = 13, SPLASHDOWN_THREADS = 14

  !> Nodes; 1 if they have rotations; particles of water and walls; memory [bytes]; step of the water [s]; number of
  !> warnings; time at the start [s].
  type, bind(c) :: splashdown_scene_sizes
    integer(c_size_t) :: nodes, rotations, fluid_particles, wall_particles
    integer(c_int64_t) :: bytes
    real(c_double) :: fluid_dt
    integer(c_size_t) :: warnings
    real(c_double) :: start_time
  end type

  !> What the water did: steps; longest next step of the water and of the host [s]; energy [J/m] and impulse [N s/m] given to
  !> the nodes; particles beyond a wall's surface and the depth of the deepest [m].
  type, bind(c) :: splashdown_contribution
    integer(c_int64_t) :: fluid_steps
    real(c_double) :: fluid_dt, host_dt, work, impulse(2)
    integer(c_int64_t) :: penetrated
    real(c_double) :: depth
  end type

  interface
    function c_message(buffer, length) result(needed) bind(c, name="splashdown_message")
      import :: c_char, c_size_t
      character(kind=c_char), intent(out) :: buffer(*)
      integer(c_size_t), value :: length
      integer(c_size_t) :: needed
    end function
    function splashdown_abi_version() result(version) bind(c, name="splashdown_abi_version")
      import :: c_int32_t
      integer(c_int32_t) :: version
    end function
    function c_set_threads(count) result(status) bind(c, name="splashdown_set_threads")
      import :: c_int, c_size_t
      integer(c_size_t), value :: count
      integer(c_int) :: status
    end function
    function c_open(scene, settings, count, interface_kind, opened) result(status) bind(c, name="splashdown_open")
      import :: c_char, c_int, c_int32_t, c_ptr, c_size_t
      character(kind=c_char), intent(in) :: scene(*)
      type(c_ptr), intent(in) :: settings(*)
      integer(c_size_t), value :: count
      integer(c_int32_t), value :: interface_kind
      type(c_ptr), intent(inout) :: opened
      integer(c_int) :: status
    end function
    function c_sizes(scene, sizes) result(status) bind(c, name="splashdown_sizes")
      import :: c_int, c_ptr, splashdown_scene_sizes
      type(c_ptr), value :: scene
      type(splashdown_scene_sizes), intent(inout) :: sizes
      integer(c_int) :: status
    end function
    function c_scene_nodes(scene, at, v, angle, spin, n) result(status) bind(c, name="splashdown_scene_nodes")
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: scene
      real(c_double), intent(inout), optional :: at(*), v(*), angle(*), spin(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_record(scene, folder, replace) result(status) bind(c, name="splashdown_record")
      import :: c_char, c_int, c_int32_t, c_ptr
      type(c_ptr), value :: scene
      character(kind=c_char), intent(in) :: folder(*)
      integer(c_int32_t), value :: replace
      integer(c_int) :: status
    end function
    function c_build(scene, at, v, angle, spin, n, element) result(status) bind(c, name="splashdown_build")
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: scene
      real(c_double), intent(in), optional :: at(*), v(*), angle(*), spin(*)
      integer(c_size_t), value :: n
      type(c_ptr), intent(inout) :: element
      integer(c_int) :: status
    end function
    function c_contribute(element, dt, at, v, angle, spin, n, forces, contribution) result(status) &
        bind(c, name="splashdown_contribute")
      import :: c_double, c_int, c_ptr, c_size_t, splashdown_contribution
      type(c_ptr), value :: element
      real(c_double), value :: dt
      real(c_double), intent(in), optional :: at(*), v(*), angle(*), spin(*)
      integer(c_size_t), value :: n
      real(c_double), intent(inout) :: forces(*)
      type(splashdown_contribution), intent(inout), optional :: contribution
      integer(c_int) :: status
    end function
    function c_nodes(element, at, v, angle, spin, n) result(status) bind(c, name="splashdown_nodes")
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: element
      real(c_double), intent(inout), optional :: at(*), v(*), angle(*), spin(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_forces_now(element, forces, n) result(status) bind(c, name="splashdown_forces_now")
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: element
      real(c_double), intent(inout) :: forces(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_particles(element, x, y, u, v, p, spacing, length) result(status) bind(c, name="splashdown_particles")
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: element
      real(c_double), intent(inout), optional :: x(*), y(*), u(*), v(*), p(*), spacing(*)
      integer(c_size_t), value :: length
      integer(c_int) :: status
    end function
    function c_state_write(element, buffer, length) result(status) bind(c, name="splashdown_state_write")
      import :: c_int, c_int8_t, c_ptr, c_size_t
      type(c_ptr), value :: element
      integer(c_int8_t), intent(inout) :: buffer(*)
      integer(c_size_t), value :: length
      integer(c_int) :: status
    end function
    function c_state_read(element, buffer, length) result(status) bind(c, name="splashdown_state_read")
      import :: c_int, c_int8_t, c_ptr, c_size_t
      type(c_ptr), value :: element
      integer(c_int8_t), intent(in) :: buffer(*)
      integer(c_size_t), value :: length
      integer(c_int) :: status
    end function
    function c_number(element, number) result(status) bind(c, name="splashdown_time")
      import :: c_double, c_int, c_ptr
      type(c_ptr), value :: element
      real(c_double), intent(inout) :: number
      integer(c_int) :: status
    end function
    function c_fluid_dt(element, dt) result(status) bind(c, name="splashdown_fluid_dt")
      import :: c_double, c_int, c_ptr
      type(c_ptr), value :: element
      real(c_double), intent(inout) :: dt
      integer(c_int) :: status
    end function
    function c_particle_count(element, count) result(status) bind(c, name="splashdown_particle_count")
      import :: c_int, c_ptr, c_size_t
      type(c_ptr), value :: element
      integer(c_size_t), intent(inout) :: count
      integer(c_int) :: status
    end function
    function c_state_size(element, size) result(status) bind(c, name="splashdown_state_size")
      import :: c_int, c_ptr, c_size_t
      type(c_ptr), value :: element
      integer(c_size_t), intent(inout) :: size
      integer(c_int) :: status
    end function
    function c_save(element) result(status) bind(c, name="splashdown_save")
      import :: c_int, c_ptr
      type(c_ptr), value :: element
      integer(c_int) :: status
    end function
    function c_restore(element) result(status) bind(c, name="splashdown_restore")
      import :: c_int, c_ptr
      type(c_ptr), value :: element
      integer(c_int) :: status
    end function
    function c_finish(element) result(status) bind(c, name="splashdown_finish")
      import :: c_int, c_ptr
      type(c_ptr), value :: element
      integer(c_int) :: status
    end function
    function c_free_element(element) result(status) bind(c, name="splashdown_free_element")
      import :: c_int, c_ptr
      type(c_ptr), value :: element
      integer(c_int) :: status
    end function
    function c_free_scene(scene) result(status) bind(c, name="splashdown_free_scene")
      import :: c_int, c_ptr
      type(c_ptr), value :: scene
      integer(c_int) :: status
    end function
  end interface
end module
