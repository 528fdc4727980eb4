!> Water under the body of a host program in Fortran: the C interface (bindings/c/include/splashdown.h) under the same names.
!>
!> Four phases: splashdown_open, splashdown_sizes, splashdown_build, splashdown_contribute. Positions, velocities and forces
!> are arrays (2, n), (2, n) and (3, n). Units are SI, angles are in radians, loads are per metre of span.
!>
!> Every procedure has the optional arguments stat (0: done, otherwise one of the constants SPLASHDOWN_INPUT, ...) and message, which
!> gets the text of an error, cut to its length, as errmsg of the language does. Without stat an error stops the program with the text.
module splashdown
  use, intrinsic :: iso_c_binding
  use splashdown_c
  implicit none
  private

  public :: splashdown_scene, splashdown_element, splashdown_scene_sizes, splashdown_contribution, splashdown_host_nodes
  public :: splashdown_open, splashdown_sizes, splashdown_scene_nodes, splashdown_record, splashdown_free_scene
  public :: splashdown_build, splashdown_contribute, splashdown_save, splashdown_restore, splashdown_finish
  public :: splashdown_nodes_now, splashdown_forces_now, splashdown_time, splashdown_fluid_dt, splashdown_particle_count
  public :: splashdown_particles, splashdown_state, splashdown_state_read, splashdown_free_element
  public :: splashdown_set_threads, splashdown_abi_version
  public :: SPLASHDOWN_BODY, SPLASHDOWN_NODES, SPLASHDOWN_TURNING_NODES
  public :: SPLASHDOWN_OK, SPLASHDOWN_NULL, SPLASHDOWN_LENGTH, SPLASHDOWN_NOT_UTF8, SPLASHDOWN_INPUT, SPLASHDOWN_STEP, &
            SPLASHDOWN_FAILED, SPLASHDOWN_NOTHING_SAVED, SPLASHDOWN_NO_STATE, SPLASHDOWN_FILE, SPLASHDOWN_BUSY, &
            SPLASHDOWN_NO_HANDLE, SPLASHDOWN_PANIC, SPLASHDOWN_AFTER_PANIC, SPLASHDOWN_THREADS

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
  subroutine return_status(status, stat, message, text)
    integer(c_int), intent(in) :: status
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    character(len=*), intent(in), optional :: text
    character(len=:), allocatable :: reason
    if (present(stat)) stat = status
    if (status == SPLASHDOWN_OK) return
    if (present(text)) then
      reason = text
    else
      reason = last_message()
    end if
    if (present(message)) message = reason
    if (.not. present(stat)) error stop "splashdown: "//reason
  end subroutine

  !> True, with stat and message, unless the arrays of nodes have one length and forces, where given, has (3, n).
  function uneven(nodes, stat, message, forces) result(wrong)
    type(splashdown_host_nodes), intent(in) :: nodes
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
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
    if (wrong) call return_status(SPLASHDOWN_LENGTH, stat, message, "arrays of nodes: expected position(2, n), velocity(2, n), "// &
                         "rotation(n) and spin(n) or none, forces(3, n)")
  end function

  !> Threads of the pool that all elements share, before the first scene is opened; 0 for one per core.
  subroutine splashdown_set_threads(count, stat, message)
    integer, intent(in) :: count
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_set_threads(int(max(count, 0), c_size_t)), stat, message)
  end subroutine

  !> Specify: a built-in scene or the path of a TOML file, with settings "key=value"; trailing blanks do not count.
  subroutine splashdown_open(scene, settings, interface_kind, opened, stat, message)
    character(len=*), intent(in) :: scene
    character(len=*), intent(in) :: settings(:)
    integer(c_int32_t), intent(in) :: interface_kind
    type(splashdown_scene), intent(inout) :: opened
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    character(len=len(settings) + 1), target :: texts(size(settings))
    type(c_ptr) :: pointers(size(settings))
    integer :: k
    do k = 1, size(settings)
      texts(k) = trim(settings(k))//c_null_char
      pointers(k) = c_loc(texts(k) (1:1))
    end do
    call return_status(c_open(trim(scene)//c_null_char, pointers, size(settings, kind=c_size_t), interface_kind, opened%handle), &
              stat, message)
  end subroutine

  !> Size: nodes, particles, bytes, step.
  subroutine splashdown_sizes(scene, sizes, stat, message)
    type(splashdown_scene), intent(in) :: scene
    type(splashdown_scene_sizes), intent(inout) :: sizes
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_sizes(scene%handle, sizes), stat, message)
  end subroutine

  !> The nodes at the start, allocated here, with the motion that the scene gives them.
  subroutine splashdown_scene_nodes(scene, nodes, stat, message)
    type(splashdown_scene), intent(in) :: scene
    type(splashdown_host_nodes), intent(out) :: nodes
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    type(splashdown_scene_sizes) :: sizes
    integer(c_int) :: status
    status = c_sizes(scene%handle, sizes)
    if (status == SPLASHDOWN_OK) then
      allocate (nodes%position(2, sizes%nodes), nodes%velocity(2, sizes%nodes))
      if (sizes%rotations == 1) allocate (nodes%rotation(sizes%nodes), nodes%spin(sizes%nodes))
      status = c_scene_nodes(scene%handle, nodes%position, nodes%velocity, nodes%rotation, nodes%spin, sizes%nodes)
    end if
    call return_status(status, stat, message)
  end subroutine

  !> Record the run in a folder; replace a run that is there, or refuse the folder. splashdown_finish writes the report.
  subroutine splashdown_record(scene, folder, replace, stat, message)
    type(splashdown_scene), intent(in) :: scene
    character(len=*), intent(in) :: folder
    logical, intent(in) :: replace
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_record(scene%handle, trim(folder)//c_null_char, merge(1_c_int32_t, 0_c_int32_t, replace)), stat, message)
  end subroutine

  !> Build the water at the start, around nodes that stand where splashdown_scene_nodes has them. The scene is consumed.
  subroutine splashdown_build(scene, nodes, element, stat, message)
    type(splashdown_scene), intent(in) :: scene
    type(splashdown_host_nodes), intent(in) :: nodes
    type(splashdown_element), intent(inout) :: element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    if (uneven(nodes, stat, message)) return
    call return_status(c_build(scene%handle, nodes%position, nodes%velocity, nodes%rotation, nodes%spin, &
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
    character(len=*), intent(inout), optional :: message
    if (uneven(nodes, stat, message, forces)) return
    call return_status(c_contribute(element%handle, dt, nodes%position, nodes%velocity, nodes%rotation, nodes%spin, &
                           size(nodes%position, 2, c_size_t), forces, contribution), stat, message)
  end subroutine

  !> Store the present state.
  subroutine splashdown_save(element, stat, message)
    type(splashdown_element), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_save(element%handle), stat, message)
  end subroutine

  !> Return to the state last saved.
  subroutine splashdown_restore(element, stat, message)
    type(splashdown_element), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_restore(element%handle), stat, message)
  end subroutine

  !> The nodes now, into arrays that have their lengths already, such as those of splashdown_scene_nodes.
  subroutine splashdown_nodes_now(element, nodes, stat, message)
    type(splashdown_element), intent(in) :: element
    type(splashdown_host_nodes), intent(inout) :: nodes
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    if (uneven(nodes, stat, message)) return
    call return_status(c_nodes(element%handle, nodes%position, nodes%velocity, nodes%rotation, nodes%spin, &
                      size(nodes%position, 2, c_size_t)), stat, message)
  end subroutine

  !> Forces of the water on the nodes at this instant, (3, n).
  subroutine splashdown_forces_now(element, forces, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(inout), contiguous :: forces(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_forces_now(element%handle, forces, size(forces, kind=c_size_t)/3), stat, message)
  end subroutine

  !> Time of the water [s].
  subroutine splashdown_time(element, time, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(inout) :: time
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_number(element%handle, time), stat, message)
  end subroutine

  !> Longest step that the water could take next [s].
  subroutine splashdown_fluid_dt(element, dt, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(inout) :: dt
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_fluid_dt(element%handle, dt), stat, message)
  end subroutine

  !> Number of the water's particles now.
  subroutine splashdown_particle_count(element, count, stat, message)
    type(splashdown_element), intent(in) :: element
    integer(c_size_t), intent(inout) :: count
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_particle_count(element%handle, count), stat, message)
  end subroutine

  !> Positions x, y [m], velocities u, v [m/s], pressures p [Pa] and spacings [m] of the water's particles.
  subroutine splashdown_particles(element, x, y, u, v, p, spacing, stat, message)
    type(splashdown_element), intent(in) :: element
    real(c_double), intent(inout), contiguous :: x(:), y(:), u(:), v(:), p(:), spacing(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    integer(c_size_t) :: length
    length = min(size(x), size(y), size(u), size(v), size(p), size(spacing))
    call return_status(c_particles(element%handle, x, y, u, v, p, spacing, length), stat, message)
  end subroutine

  !> The present state as bytes, allocated here, to continue in another process.
  subroutine splashdown_state(element, bytes, stat, message)
    type(splashdown_element), intent(in) :: element
    integer(c_int8_t), allocatable, intent(out) :: bytes(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    integer(c_size_t) :: length
    integer(c_int) :: status
    length = 0
    status = c_state_size(element%handle, length)
    allocate (bytes(length))
    if (status == SPLASHDOWN_OK) status = c_state_write(element%handle, bytes, length)
    call return_status(status, stat, message)
  end subroutine

  !> Take the state of an element that was built alike.
  subroutine splashdown_state_read(element, bytes, stat, message)
    type(splashdown_element), intent(in) :: element
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_state_read(element%handle, bytes, size(bytes, kind=c_size_t)), stat, message)
  end subroutine

  !> End the run; write summary and report where it is recorded. The element is consumed.
  subroutine splashdown_finish(element, stat, message)
    type(splashdown_element), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_finish(element%handle), stat, message)
  end subroutine

  !> Free an element without ending its run.
  subroutine splashdown_free_element(element, stat, message)
    type(splashdown_element), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_free_element(element%handle), stat, message)
  end subroutine

  !> Free a scene that was not built.
  subroutine splashdown_free_scene(scene, stat, message)
    type(splashdown_scene), intent(in) :: scene
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: message
    call return_status(c_free_scene(scene%handle), stat, message)
  end subroutine
end module
