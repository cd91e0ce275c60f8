// The page of a live view: pictures come over a websocket, events and changes of the panel go back over it.
// renderview.js is rendercanvas' own; it turns what mouse, touch and keyboard do into events.

import { showPanel, showProblem } from './panel.js'

/* global BaseRenderView */
const byId = (id) => document.getElementById(id)
const picture = byId('picture')
const help = byId('help')
const FIRST_WAIT = 250 // milliseconds until a lost connection is tried again; the wait doubles up to LAST_WAIT
const LAST_WAIT = 4000
const PAUSE = 16

let socket = null
let wait = FIRST_WAIT

const send = (message) => {
  if (socket !== null && socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message))
}

// ---- the picture

class PageView extends BaseRenderView {
  constructor () {
    picture.style.width = picture.style.height = '100%'
    super(picture, null)
    this.setThrottle(0) // its own throttle lets a move overtake the press that follows it; see `onEvent`
    this.waiting = null
    this.newest = null
    this.planned = false
    this.lastSize = null
    this.fingers = new Map()
    picture.addEventListener('wheel', () => this._focusElement.focus({ preventScroll: true }), { capture: true })
    picture.addEventListener('pointerenter', () => { if (!isTyping()) this._focusElement.focus({ preventScroll: true }) })
    for (const type of ['pointerdown', 'pointermove', 'pointerup', 'pointercancel']) {
      picture.addEventListener(type, (event) => this.touch(event), { capture: true })
    }
    this._focusElement.setAttribute('aria-label', 'Keys for the view')
  }

  onEvent (event) {
    if (event.type === 'resize') this.lastSize = event
    if (event.key === 'h' && byId('help-text').textContent && event.modifiers.length === 0) {
      if (event.type === 'key_down') help.showModal()
    } else if (event.type === 'pointer_move' || event.type === 'wheel') {
      this.sendSoon(event)
    } else {
      this.sendWaiting()
      send(event)
    }
  }

  // Moves and wheels become one message in PAUSE milliseconds; they never overtake other events.
  sendSoon (event) {
    const last = this.waiting
    const same = last !== null && ['type', 'buttons', 'modifiers'].every((key) => String(last[key]) === String(event[key]))
    if (same && event.type === 'wheel') {
      event.dx += last.dx
      event.dy += last.dy
    } else if (!same) this.sendWaiting()
    if (this.waiting === null) setTimeout(() => this.sendWaiting(), PAUSE)
    this.waiting = event
  }

  sendWaiting () {
    if (this.waiting !== null) send(this.waiting)
    this.waiting = null
  }

  // Of the frames that arrive between two pictures of the screen the last one is shown, and that one is confirmed.
  push (frame) {
    this.newest = frame
    if (!this.planned) {
      this.planned = true
      requestAnimationFrame(() => this.show())
    }
  }

  show () {
    this.planned = false
    const frame = this.newest
    const address = URL.createObjectURL(new Blob([frame.data], { type: frame.mimetype }))
    const old = picture.src
    picture.onload = picture.onerror = () => { if (old.startsWith('blob:')) URL.revokeObjectURL(old) }
    picture.src = address
    document.body.classList.add('live')
    picture.dataset.frame = frame.index
    picture.dataset.kind = frame.mimetype
    send({ type: '_framefeedback', index: frame.index, timestamp: frame.timestamp })
  }

  // renderview.js knows one finger. With two, the view gets both in `touches`, as rendercanvas describes it.
  touch (event) {
    if (event.pointerType !== 'touch') return
    const before = this.fingers.size
    if (event.type === 'pointerup' || event.type === 'pointercancel') this.fingers.delete(event.pointerId)
    else if (event.type === 'pointerdown' || this.fingers.has(event.pointerId)) {
      this.fingers.set(event.pointerId, { x: event.offsetX, y: event.offsetY })
    }
    if (before < 2 && this.fingers.size < 2) return
    event.stopImmediatePropagation()
    const type = { pointerdown: 'pointer_down', pointermove: 'pointer_move' }[event.type] ?? 'pointer_up'
    const touches = this.fingers.size < 2 ? {} : Object.fromEntries(this.fingers)
    send({ type, x: event.offsetX, y: event.offsetY, button: 1, buttons: [1], modifiers: [], touches })
  }
}

const isTyping = () => document.activeElement !== null && document.activeElement.closest('#panel input:not([type=range]):not([type=checkbox])') !== null
const view = new PageView()

// ---- the connection

const receivers = {
  title: (value) => { document.title = byId('title').textContent = value },
  text: (value) => { byId('text').textContent = value },
  cursor: (value) => { picture.style.cursor = value },
  help: (value) => { // a line for each: what one does, two spaces, what happens then
    byId('help-text').replaceChildren(...value.split('\n').filter((line) => line.trim()).flatMap((line) => {
      const [, does, happens] = line.trim().match(/^(.*?)(?: {2,}(.*))?$/)
      return [['dt', does], ['dd', happens ?? '']].map(([tag, text]) => Object.assign(document.createElement(tag), { textContent: text }))
    }))
    byId('ask').hidden = !value
  },
  panel: (value) => showPanel(byId('sections'), value, (control, newValue) => send({ type: 'control', control, value: newValue }), foldPanel)
}

function connect () {
  let head = null // the message whose picture comes next
  socket = new WebSocket(`ws://${location.host}${location.pathname}`)
  socket.binaryType = 'arraybuffer'
  socket.onopen = () => {
    wait = FIRST_WAIT
    byId('notice').hidden = true
    if (view.lastSize !== null) send(view.lastSize)
  }
  socket.onmessage = (event) => {
    if (typeof event.data !== 'string') {
      if (head !== null) view.push({ ...head, data: event.data })
      head = null
      return
    }
    const message = JSON.parse(event.data)
    if (message.type === 'framebufferdata') head = message
    else if (message.type in receivers) receivers[message.type](message.value)
    else if (message.type.startsWith('problem ')) showProblem(message.type.slice(8).split(' '), message.value)
  }
  socket.onclose = () => {
    const notice = byId('notice')
    notice.textContent = 'The connection to the program is lost; the page tries again.'
    notice.hidden = false
    setTimeout(connect, wait)
    wait = Math.min(2 * wait, LAST_WAIT)
  }
}

// ---- the panel and the help

let folded = window.matchMedia('(max-width: 640px)').matches

function foldPanel (fold = folded) {
  folded = fold
  const some = byId('sections').children.length > 0
  byId('panel').hidden = folded || !some
  byId('unfold').hidden = !folded || !some
}

byId('fold').onclick = () => foldPanel(true)
byId('unfold').onclick = () => foldPanel(false)
byId('ask').onclick = () => help.showModal()
byId('sections').onsubmit = (event) => event.preventDefault()
help.onclick = () => help.close()
help.onkeydown = (event) => { if (event.key === 'h') help.close() }

connect()
