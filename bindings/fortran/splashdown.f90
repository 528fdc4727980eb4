!> Water under the body of a host program in Fortran: the C interface (bindings/c/include/splashdown.h) under the same names.
!>
!> Four phases: splashdown_open, splashdown_sizes, splashdown_build, splashdown_contribute. Positions, velocities and forces
!> are arrays (2, n), (2, n) and (3, n). Units are SI, angles are in radians, loads are per metre of span.
!>
!> Every procedure has the optional arguments stat (0: done, otherwise one of the constants below) and message (its text).
!> Without stat an error stops the program with the text.
module splashdown
  use, intrinsic :: iso_c_binding
  implicit none
  private

  public :: splashdown_scene, splashdown_element, splashdown_scene_sizes, splashdown_contribution, splashdown_host_nodes
  public :: splashdown_open, splashdown_sizes, splashdown_scene_nodes, splashdown_record, splashdown_free_scene
  public :: splashdown_build, splashdown_contribute, splashdown_save, splashdown_restore, splashdown_finish
  public :: splashdown_nodes_now, splashdown_forces_now, splashdown_time, splashdown_fluid_dt, splashdown_particle_count
  public :: splashdown_particles, splashdown_state, splashdown_state_read, splashdown_free_element
  public :: splashdown_set_threads, splashdown_abi_version

  !> What of the body the host moves: its reference point and angle; its corners, straight between them; or bent between them.
  integer(c_int32_t), parameter, public :: SPLASHDOWN_BODY = 0, SPLASHDOWN_NODES = 1, SPLASHDOWN_TURNING_NODES = 2

  !> Values of stat.
  integer(c_int), parameter, public :: &
      SPLASHDOWN_OK = 0, SPLASHDOWN_NULL = 1, SPLASHDOWN_LENGTH = 2, SPLASHDOWN_NOT_UTF8 = 3, SPLASHDOWN_INPUT = 4, &
      SPLASHDOWN_STEP = 5, SPLASHDOWN_FAILED = 6, SPLASHDOWN_NOTHING_SAVED = 7, SPLASHDOWN_NO_STATE = 8, &
      SPLASHDOWN_FILE = 9, SPLASHDOWN_BUSY = 10, SPLASHDOWN_NO_HANDLE = 11, SPLASHDOWN_PANIC = 12, &
      SPLASHDOWN_AFTER_PANIC = 13, SPLASHDOWN_THREADS = 14

  !> A scene that is specified and sized; an element at work.
  type :: splashdown_scene
    type(c_ptr) :: handle = c_null_ptr
  end type
  type :: splashdown_element
    type(c_ptr) :: handle = c_null_ptr
  end type

  !> Positions (2, n) [m], velocities (2, n) [m/s], rotations (n) [rad], spins (n) [rad/s] of the nodes; the last two are
  !> not allocated where nodes have no rotations.
  type :: splashdown_host_nodes
    real(c_double), allocatable :: position(:, :), velocity(:, :), rotation(:), spin(:)
  end type

  !> Nodes; 1 if they have rotations; particles of water and walls; memory [bytes]; step of the water [s]; number of warnings.
  type, bind(c) :: splashdown_scene_sizes
    integer(c_size_t) :: nodes, rotations, fluid_particles, wall_particles
    integer(c_int64_t) :: bytes
    real(c_double) :: fluid_dt
    integer(c_size_t) :: warnings
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

contains

  !> Text of this thread's last error.
  function last_message() result(text)
    character(len=:), allocatable :: text
    character(kind=c_char), allocatable :: buffer(:)
    integer(c_size_t) :: needed, k
    allocate (buffer(4096))
    needed = min(c_message(buffer, size(buffer, kind=c_size_t)), size(buffer, kind=c_size_t))
    allocate (character(len=max(needed - 1, 0_c_size_t)) :: text)
    do k = 1, len(text)
      text(k:k) = buffer(k)
    end do
  end function

  !> How a call ended, to the caller: by stat and message, or by the end of the program.
  subroutine tell(status, stat, message, text)
    integer(c_int), intent(in) :: status
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    character(len=*), intent(in), optional :: text
    character(len=:), allocatable :: said
    said = ""
    if (status /= SPLASHDOWN_OK) then
      if (present(text)) then
        said = text
      else
        said = last_message()
      end if
    end if
    if (present(message)) message = said
    if (present(stat)) then
      stat = status
    else if (status /= SPLASHDOWN_OK) then
      error stop "splashdown: "//said
    end if
  end subroutine

  !> True, with stat and message, unless the arrays of nodes have one length and forces, where given, has (3, n).
  function uneven(nodes, stat, message, forces) result(wrong)
    type(splashdown_host_nodes), intent(in) :: nodes
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    real(c_double), intent(in), optional :: forces(:, :)
    logical :: wrong
    integer :: n
    n = -1
    if (allocated(nodes%position)) n = size(nodes%position, 2)
    wrong = n < 0 .or. .not. allocated(nodes%velocity)
    if (.not. wrong) wrong = size(nodes%position, 1) /= 2 .or. any(shape(nodes%velocity) /= [2, n])
    if (.not. wrong .and. allocated(nodes%rotation)) wrong = size(nodes%rotation) /= n
    if (.not. wrong .and. allocated(nodes%spin)) wrong = size(nodes%spin) /= n
    if (.not. wrong .and. present(forces)) wrong = any(shape(forces) /= [3, n])
    if (wrong) call tell(SPLASHDOWN_LENGTH, stat, message, "arrays of nodes: expected position(2, n), velocity(2, n), "// &
                         "rotation(n) and spin(n) or none, forces(3, n)")
  end function

  !> Threads of the pool that all elements share, before the first scene is opened; 0 for one per core.
  subroutine splashdown_set_threads(count, stat, message)
    integer, intent(in) :: count
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_set_threads(int(max(count, 0), c_size_t)), stat, message)
  end subroutine

  !> Specify: a built-in scene or the path of a TOML file, with settings "key=value"; trailing blanks do not count.
  subroutine splashdown_open(scene, settings, interface_kind, opened, stat, message)
    character(len=*), intent(in) :: scene
    character(len=*), intent(in) :: settings(:)
    integer(c_int32_t), intent(in) :: interface_kind
    type(splashdown_scene), intent(inout) :: opened
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    character(len=len(settings) + 1), target :: texts(size(settings))
    type(c_ptr) :: pointers(size(settings))
    integer :: k
    do k = 1, size(settings)
      texts(k) = trim(settings(k))//c_null_char
      pointers(k) = c_loc(texts(k) (1:1))
    end do
    call tell(c_open(trim(scene)//c_null_char, pointers, size(settings, kind=c_size_t), interface_kind, opened%handle), &
              stat, message)
  end subroutine

  !> Size: nodes, particles, bytes, step.
  subroutine splashdown_sizes(scene, sizes, stat, message)
    type(splashdown_scene), intent(in) :: scene
    type(splashdown_scene_sizes), intent(inout) :: sizes
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_sizes(scene%handle, sizes), stat, message)
  end subroutine

  !> The nodes at t = 0, allocated here, with the initial velocity of the scene.
  subroutine splashdown_scene_nodes(scene, nodes, stat, message)
    type(splashdown_scene), intent(in) :: scene
    type(splashdown_host_nodes), intent(out) :: nodes
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    type(splashdown_scene_sizes) :: sizes
    integer(c_int) :: status
    status = c_sizes(scene%handle, sizes)
    if (status == SPLASHDOWN_OK) then
      allocate (nodes%position(2, sizes%nodes), nodes%velocity(2, sizes%nodes))
      if (sizes%rotations == 1) allocate (nodes%rotation(sizes%nodes), nodes%spin(sizes%nodes))
      status = c_scene_nodes(scene%handle, nodes%position, nodes%velocity, nodes%rotation, nodes%spin, sizes%nodes)
    end if
    call tell(status, stat, message)
  end subroutine

  !> Record the run in a folder; replace a run that is there, or refuse the folder. splashdown_finish writes the report.
  subroutine splashdown_record(scene, folder, replace, stat, message)
    type(splashdown_scene), intent(in) :: scene
    character(len=*), intent(in) :: folder
    logical, intent(in) :: replace
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_record(scene%handle, trim(folder)//c_null_char, merge(1_c_int32_t, 0_c_int32_t, replace)), stat, message)
  end subroutine

  !> Build the water at t = 0. The scene is consumed, as the header says.
  subroutine splashdown_build(scene, nodes, element, stat, message)
    type(splashdown_scene), intent(in) :: scene
    type(splashdown_host_nodes), intent(in) :: nodes
    type(splashdown_element), intent(inout) :: element
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    if (uneven(nodes, stat, message)) return
    call tell(c_build(scene%handle, nodes%position, nodes%velocity, nodes%rotation, nodes%spin, &
                      size(nodes%position, 2, c_size_t), element%handle), stat, message)
  end subroutine

  !> Contribute: the water goes through a step dt [s] of the host, to where the nodes are at its end; mean forces
  !> F_x, F_y [N/m] and M [N] of each node.
  subroutine splashdown_contribute(element, dt, nodes, forces, contribution, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(in) :: dt
    type(splashdown_host_nodes), intent(in) :: nodes
    real(c_double), intent(inout), contiguous :: forces(:, :)
    type(splashdown_contribution), intent(inout), optional :: contribution
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    if (uneven(nodes, stat, message, forces)) return
    call tell(c_contribute(element%handle, dt, nodes%position, nodes%velocity, nodes%rotation, nodes%spin, &
                           size(nodes%position, 2, c_size_t), forces, contribution), stat, message)
  end subroutine

  !> Remember the present state.
  subroutine splashdown_save(element, stat, message)
    type(splashdown_element), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_save(element%handle), stat, message)
  end subroutine

  !> Return to the state last saved.
  subroutine splashdown_restore(element, stat, message)
    type(splashdown_element), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_restore(element%handle), stat, message)
  end subroutine

  !> The nodes now, into arrays that have their lengths already, such as those of splashdown_scene_nodes.
  subroutine splashdown_nodes_now(element, nodes, stat, message)
    type(splashdown_element), intent(in) :: element
    type(splashdown_host_nodes), intent(inout) :: nodes
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    if (uneven(nodes, stat, message)) return
    call tell(c_nodes(element%handle, nodes%position, nodes%velocity, nodes%rotation, nodes%spin, &
                      size(nodes%position, 2, c_size_t)), stat, message)
  end subroutine

  !> Forces of the water on the nodes at this instant, (3, n).
  subroutine splashdown_forces_now(element, forces, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(inout), contiguous :: forces(:, :)
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_forces_now(element%handle, forces, size(forces, kind=c_size_t)/3), stat, message)
  end subroutine

  !> Time of the water [s].
  subroutine splashdown_time(element, time, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(inout) :: time
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_number(element%handle, time), stat, message)
  end subroutine

  !> Longest step that the water could take next [s].
  subroutine splashdown_fluid_dt(element, dt, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(inout) :: dt
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_fluid_dt(element%handle, dt), stat, message)
  end subroutine

  !> Number of the water's particles now.
  subroutine splashdown_particle_count(element, count, stat, message)
    type(splashdown_element), intent(in) :: element
    integer(c_size_t), intent(inout) :: count
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_particle_count(element%handle, count), stat, message)
  end subroutine

  !> Positions x, y [m], velocities u, v [m/s], pressures p [Pa] and spacings [m] of the water's particles.
  subroutine splashdown_particles(element, x, y, u, v, p, spacing, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(inout), contiguous :: x(:), y(:), u(:), v(:), p(:), spacing(:)
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    integer(c_size_t) :: length
    length = min(size(x), size(y), size(u), size(v), size(p), size(spacing))
    call tell(c_particles(element%handle, x, y, u, v, p, spacing, length), stat, message)
  end subroutine

  !> The present state as bytes, allocated here, to continue in another process.
  subroutine splashdown_state(element, bytes, stat, message)
    type(splashdown_element), intent(in) :: element
    integer(c_int8_t), allocatable, intent(out) :: bytes(:)
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    integer(c_size_t) :: length
    integer(c_int) :: status
    length = 0
    status = c_state_size(element%handle, length)
    allocate (bytes(length))
    if (status == SPLASHDOWN_OK) status = c_state_write(element%handle, bytes, length)
    call tell(status, stat, message)
  end subroutine

  !> Take the state of an element that was built alike.
  subroutine splashdown_state_read(element, bytes, stat, message)
    type(splashdown_element), intent(in) :: element
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_state_read(element%handle, bytes, size(bytes, kind=c_size_t)), stat, message)
  end subroutine

  !> End the run; write summary and report where it is recorded. The element is consumed.
  subroutine splashdown_finish(element, stat, message)
    type(splashdown_element), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_finish(element%handle), stat, message)
  end subroutine

  !> Free an element without ending its run.
  subroutine splashdown_free_element(element, stat, message)
    type(splashdown_element), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_free_element(element%handle), stat, message)
  end subroutine

  !> Free a scene that was not built.
  subroutine splashdown_free_scene(scene, stat, message)
    type(splashdown_scene), intent(in) :: scene
    integer, intent(out), optional :: stat
    character(len=:), allocatable, intent(out), optional :: message
    call tell(c_free_scene(scene%handle), stat, message)
  end subroutine
end module
